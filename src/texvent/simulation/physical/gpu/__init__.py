"""The `physical` model as Triton kernels."""
