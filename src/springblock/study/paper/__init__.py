"""The figures of the paper, and of surfaces like its own."""
