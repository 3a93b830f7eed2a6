"""What is on a table, a desk or a dish, and who sits at it."""
