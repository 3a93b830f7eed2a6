"""Text formats: CSV, ECD, E2VID."""
