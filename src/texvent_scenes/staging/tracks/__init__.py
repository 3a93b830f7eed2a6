"""Tracks: positions as pure functions of time."""
