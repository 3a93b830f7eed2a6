"""Interpolation and simulation in one pass: what joins stages that do not know each other."""
