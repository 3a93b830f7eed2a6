"""ESIM: every threshold crossing of linearly interpolated log intensity."""
