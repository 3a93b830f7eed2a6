"""Whether the staged scene shows what the prompt says: relations, acts and moves of the camera."""
