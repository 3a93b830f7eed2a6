"""Still images of events."""
