"""Statistics, correlations and comparisons of realisations."""
