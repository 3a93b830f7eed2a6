"""What places are known by: furniture of rooms, structures of grounds, lines of courts."""
