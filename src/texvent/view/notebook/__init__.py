"""What values show of themselves in a notebook: stills, event rates, facts, a cloud to turn."""
