"""Closed forms and theories of a layer: its elasticity, friction, and slip precursors."""
