"""Kernels of the Texvent model: scan, noise, time stamps."""
