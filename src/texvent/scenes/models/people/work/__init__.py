"""Hand work: its verbs, how hands move, tools, and where all of it is."""
