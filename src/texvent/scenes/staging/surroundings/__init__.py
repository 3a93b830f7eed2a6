"""What is around the objects: place, ground, roads, scenery, weather, light."""
