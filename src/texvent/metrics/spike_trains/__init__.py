"""Metrics that compare the ON and OFF events of each pixel as trains."""
