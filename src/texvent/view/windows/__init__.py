"""Windows of events, their source frame and ground truth, and how they are drawn."""
