"""The Texvent model as Triton kernels."""
