"""What a run found: scores, tests, tables, charts, a page."""
