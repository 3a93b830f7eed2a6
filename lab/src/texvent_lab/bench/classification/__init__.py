"""Classifiers of event streams, and streams of different scenes."""
