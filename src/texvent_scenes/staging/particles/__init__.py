"""Smoke, sparks, drops, leaves, pieces: many small things, each a function of time and seed."""
