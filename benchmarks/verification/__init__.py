"""Verification problems: small surfaces, references, and metrics for any code.

README.md beside this file specifies them; `python -m benchmarks.verification --help` compares.
"""
