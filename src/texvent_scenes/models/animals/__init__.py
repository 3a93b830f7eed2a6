"""Models of animals."""
