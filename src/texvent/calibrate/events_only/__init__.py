"""Constants of a sensor from recordings without frames, of scenes that are known."""
