"""The error study: errors of single runs and of ensembles, and the page on them."""
