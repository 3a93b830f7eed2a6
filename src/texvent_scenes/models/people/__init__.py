"""People: bodies with joints, what they do, what they wear."""
