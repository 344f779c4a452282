"""What the full study finds, in short."""
