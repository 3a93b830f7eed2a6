"""Shading: light that surfaces, sky and water send to the camera (Numba kernels)."""
