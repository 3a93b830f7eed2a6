"""A description becomes a scene: places, placement, motion, camera, weather."""
