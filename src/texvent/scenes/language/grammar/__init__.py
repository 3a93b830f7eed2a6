"""Words to clauses."""
