"""Cameras that people have: their constants with sources, and their biases."""
