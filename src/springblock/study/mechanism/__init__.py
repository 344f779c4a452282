"""Why friction depends on the size of pillars."""
