"""Events of a Blender film at 24 fps with motion vectors, beside those of 480 frames per second."""
