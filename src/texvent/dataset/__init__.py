"""Training samples, simulated when they are asked for."""
