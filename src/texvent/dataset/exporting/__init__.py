"""Data sets in the layouts of others."""
