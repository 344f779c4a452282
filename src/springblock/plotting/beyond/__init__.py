"""Questions beyond the paper, a figure each."""
