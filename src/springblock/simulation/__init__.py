"""Simulation of one realisation: setup, prelude, run and results."""
