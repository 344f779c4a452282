"""Configuration of a study, cost of its jobs, and state of its results."""
