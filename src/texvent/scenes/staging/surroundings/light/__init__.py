"""Light of the sky, of lamps and of lightning."""
