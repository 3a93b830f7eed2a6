"""Stage 2, video → dense frames: how many intermediate frames, and what they show."""
