"""Batches of short 8-bit clips for training: pixels drawn per clip, dense arrays without events."""
