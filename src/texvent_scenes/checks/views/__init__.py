"""Checks of what the camera sees: shots, its ways, small pictures and surfaces in them."""
