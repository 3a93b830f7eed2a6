"""Compiled functions that the kernels of several models share."""
