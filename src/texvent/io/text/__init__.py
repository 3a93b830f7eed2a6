"""Text formats: Event Camera Dataset, E2VID, CSV."""
