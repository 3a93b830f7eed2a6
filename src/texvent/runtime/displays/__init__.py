"""Displays: progress in terminals and notebooks, values in notebooks."""
