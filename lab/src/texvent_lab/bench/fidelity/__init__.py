"""Simulators against the exact events of the oracle."""
