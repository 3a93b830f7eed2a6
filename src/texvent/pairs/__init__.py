"""Pairs of source frames: motion, scene changes and instants between them."""
