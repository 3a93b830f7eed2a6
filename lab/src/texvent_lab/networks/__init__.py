"""Layers that several networks of the laboratory are made of."""
