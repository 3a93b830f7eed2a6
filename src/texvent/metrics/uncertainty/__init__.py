"""How sure a mean of windows and a difference between two candidates are."""
