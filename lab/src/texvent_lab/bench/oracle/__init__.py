"""Scenes with exactly known events."""
