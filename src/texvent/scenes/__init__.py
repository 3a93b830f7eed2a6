"""Text to scene: sentence → 3-D scene → frames with exact ground truth."""
