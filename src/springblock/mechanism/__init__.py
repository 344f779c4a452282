"""Why friction depends on the size of pillars: four models of increasing content."""
