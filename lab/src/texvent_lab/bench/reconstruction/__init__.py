"""Simulators scored by the images a network reconstructs from their events."""
