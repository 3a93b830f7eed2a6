"""The scene as a value, in files and in Python."""
