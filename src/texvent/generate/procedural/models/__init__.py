"""Everyday things built from unit shapes: one file per family, one table of nouns."""
