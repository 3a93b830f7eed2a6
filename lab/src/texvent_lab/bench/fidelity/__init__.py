"""Scores of simulators against known events: entries, fit of δ, tables."""
