"""Checks of words against the staged scene and its picture: colours, light, weather, effects."""
