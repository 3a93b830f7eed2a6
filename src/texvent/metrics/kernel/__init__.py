"""Both streams smoothed by a kernel in time and space."""
