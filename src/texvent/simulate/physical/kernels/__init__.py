"""Kernels of the physical model: the pixel circuit and its threshold crossings."""
