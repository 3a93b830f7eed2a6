"""texvent: text prompts and videos to event-camera streams."""
