"""Scene description → animated scene: environment, positions, trajectories, camera, weather."""
