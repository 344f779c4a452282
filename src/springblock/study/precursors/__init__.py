"""Slip precursors: what correlates the first detachments along an edge."""
