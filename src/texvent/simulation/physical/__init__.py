"""The physical model of a DVS pixel, from linear light to the readout."""
