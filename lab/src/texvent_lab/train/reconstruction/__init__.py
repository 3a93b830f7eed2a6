"""Networks that turn events into images, trained on simulated clips."""
