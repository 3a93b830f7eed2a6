"""Events → dense arrays."""
