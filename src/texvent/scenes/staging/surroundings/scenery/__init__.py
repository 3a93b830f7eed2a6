"""What stands around the objects: trees along a road, houses in a city, walls of a corridor."""
