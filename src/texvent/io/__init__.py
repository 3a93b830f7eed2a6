"""Events ↔ files: one codec per format; units, order and polarity convert here only."""
