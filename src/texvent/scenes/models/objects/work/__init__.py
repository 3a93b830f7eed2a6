"""Models of tools, machines, robots and what goods are moved with."""
