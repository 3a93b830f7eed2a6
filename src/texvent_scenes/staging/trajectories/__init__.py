"""Trajectories: positions as pure functions of time."""
