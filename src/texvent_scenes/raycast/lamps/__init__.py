"""Lamps: what they light, what stands in their light, and how they look themselves."""
