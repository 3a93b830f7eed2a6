"""Checks of where bodies are: places, streets, water, edges and supports."""
