"""Pictures, films and pages of events."""
