"""Where the camera is, what it looks at and how it moves."""
