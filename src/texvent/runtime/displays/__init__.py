"""How progress is shown: in a terminal, in a notebook."""
