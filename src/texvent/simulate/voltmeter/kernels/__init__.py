"""Kernels of DVS-Voltmeter: first-passage times."""
