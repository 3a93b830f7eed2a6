"""Displays of progress: in a terminal, in a notebook."""
