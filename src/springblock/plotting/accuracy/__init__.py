"""How large the numerical errors are, and what they cost."""
