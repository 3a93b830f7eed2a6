"""Clips of consecutive windows, for networks that remember: simulated once, then read in parts."""
