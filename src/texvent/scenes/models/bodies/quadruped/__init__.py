"""Four-legged animals: their tables, trunk and legs, and head."""
