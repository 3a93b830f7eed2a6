"""Where things are at each instant: trajectories as pure functions of time."""
