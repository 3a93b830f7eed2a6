"""Images, videos and pages of events."""
