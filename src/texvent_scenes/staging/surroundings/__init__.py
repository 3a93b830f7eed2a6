"""Surroundings of the objects: place, ground, roads, scenery, weather, light."""
