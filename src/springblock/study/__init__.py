"""The study: its configuration, its cost, and the state of its results."""
