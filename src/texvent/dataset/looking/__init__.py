"""Data sets to look at: pages, plots, contact sheets."""
