"""What the workflow's rules call; every job can be run again by hand."""
