"""Where the model applies."""
