"""Physical model: material, pattern, scene and friction coefficients."""
