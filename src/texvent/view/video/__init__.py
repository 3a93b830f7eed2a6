"""Videos of events and frames: encoding and layout over time."""
