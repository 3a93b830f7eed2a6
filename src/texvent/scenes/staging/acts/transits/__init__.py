"""Ways off, onto, into, out of, through, up and down things."""
