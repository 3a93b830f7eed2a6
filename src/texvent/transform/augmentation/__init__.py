"""Augmentations: changed copies of a sample, drawn by a seed."""
