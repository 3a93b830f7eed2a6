"""Filters: which events of a recording stay, the same packet by packet as in one piece."""
