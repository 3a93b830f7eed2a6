"""Generated videos on disk: stored, cached, checked."""
