"""Decoding of video: pixels of libav's frames, and times of its packets."""
