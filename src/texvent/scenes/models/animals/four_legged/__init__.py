"""Clothing of animals is gone; `clothing` goes with its last callers in staging."""
