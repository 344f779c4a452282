"""One realisation: set up, loaded, run, and what it yields."""
