"""Placement of things: groups of copies, relations and free places."""
