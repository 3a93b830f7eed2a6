"""Films of events, with the video beside them."""
