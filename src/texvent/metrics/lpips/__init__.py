"""LPIPS: how different two images look to a trained network."""
