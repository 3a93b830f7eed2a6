"""What the interpolation networks share: devices, weight files, tiles, warping."""
