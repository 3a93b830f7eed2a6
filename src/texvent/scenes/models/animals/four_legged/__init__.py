"""Bodies of four-legged animals: proportions, trunk and legs, head."""
