"""What light each surface sends to the camera: surfaces, textures, sky, water (Numba kernels)."""
