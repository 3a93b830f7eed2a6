"""Models drawn by another model and changed: opened, hanging, pulsing."""
