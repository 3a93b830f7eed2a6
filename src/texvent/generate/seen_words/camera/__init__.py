"""Whether the camera moves, stands and looks as its words say."""
