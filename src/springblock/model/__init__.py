"""The physical model: material, pattern, scene and friction coefficients."""
