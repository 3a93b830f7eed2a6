"""Scene description → animated scene: environment, positions, tracks, camera, weather."""
