"""Commands that train networks and score them."""
