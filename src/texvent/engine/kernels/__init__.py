"""Candidates and crossings: definitions in NumPy, and compiled kernels."""
