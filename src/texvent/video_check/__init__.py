"""What a video is like for an event camera: measures of one pass, and what they amount to."""
