"""Camera of a scene: placement, framing and motion."""
