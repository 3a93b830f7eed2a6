"""Text to clauses: phrases that the lexicon has, noun groups of them, and clauses of these."""
