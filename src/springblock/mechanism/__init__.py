"""Why friction depends on the size of pillars, and when it has two load peaks."""
