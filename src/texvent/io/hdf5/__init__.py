"""HDF5 layouts: ours, DSEC, v2e."""
