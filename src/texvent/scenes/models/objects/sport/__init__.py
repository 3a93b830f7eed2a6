"""Models of what is used in sports and games."""
