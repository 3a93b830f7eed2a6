"""Draft of a scene: its objects, effects and moves of the camera so far, fates of words."""
