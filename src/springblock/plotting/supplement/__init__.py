"""What the paper leaves open: spacing, size, angles, levels, realisations, own surfaces."""
