"""Kernels of v2e: photoreceptor low-pass, emit and reset."""
