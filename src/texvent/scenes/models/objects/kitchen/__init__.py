"""Models of what is found in a kitchen."""
