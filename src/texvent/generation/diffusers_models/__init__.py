"""Text-to-video models that diffusers runs."""
