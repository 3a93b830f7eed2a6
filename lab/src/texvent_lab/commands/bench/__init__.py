"""`texvent bench`: one benchmark per file."""
