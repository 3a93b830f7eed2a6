"""Clauses about animals: acts that their models have, and characters that stand upright."""
