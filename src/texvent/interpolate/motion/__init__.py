"""Intermediate frames from known motion: every piece of surface is followed along its path."""
