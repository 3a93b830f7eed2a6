"""Hands at work on a thing: where they touch it, and how large it is drawn."""
