"""A pair of source frames and what lies between them: motion, scene changes, instants."""
