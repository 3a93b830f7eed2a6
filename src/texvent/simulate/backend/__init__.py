"""Which kernels compute, and the elementary functions that all of them share."""
