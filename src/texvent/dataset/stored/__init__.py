"""Stored data sets: their folder and records, and their samples by number, from any process."""
