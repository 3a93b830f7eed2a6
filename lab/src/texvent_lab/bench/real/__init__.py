"""Simulators against recorded events."""
