"""From a description to a scene in space and time: placing, motion, camera, surroundings."""
