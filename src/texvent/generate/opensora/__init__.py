"""Open-Sora in the user's own installation."""
