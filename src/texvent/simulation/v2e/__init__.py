"""v2e's pixel model."""
