"""The compiled core: springs, friction, and the integrators behind one narrow interface."""
