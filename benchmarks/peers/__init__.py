"""Other programs that solve the same lattice."""
