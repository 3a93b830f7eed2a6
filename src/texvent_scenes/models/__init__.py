"""3-D models of nouns, built from solids."""
