"""Clauses to the scene description."""
