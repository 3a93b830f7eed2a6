"""Language of film: moves of the camera, and views, framings and styles."""
