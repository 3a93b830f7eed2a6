"""SENPI's pixel model."""
