"""A still image under a moving camera: its path, and what the camera sees at any instant."""
