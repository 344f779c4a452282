"""What a benchmark says of a peer that this machine does not have."""


class Missing(Exception):
    """This peer cannot be timed here; the message says why."""
