"""Loops over words and events, compiled by Numba; imported when a file of that format is used."""
