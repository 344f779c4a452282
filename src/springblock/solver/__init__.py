"""Compiled kernels: springs, friction laws, and the integrators behind one interface."""
