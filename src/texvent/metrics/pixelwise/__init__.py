"""Errors of images of optical flow and of depth against the truth, pixel by pixel."""
