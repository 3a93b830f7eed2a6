"""Notebook displays of values: stills, event rates, facts, a cloud to turn."""
