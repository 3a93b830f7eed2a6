"""Windows of events with the frame displayed beside them, and how they look."""
