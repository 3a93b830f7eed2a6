"""ESIM as Triton kernels."""
