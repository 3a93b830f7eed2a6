"""Interpolation and simulation in one pass: pixels are evaluated only where they may fire."""
