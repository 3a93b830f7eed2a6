"""NT-ImageNet: recorded events of N-ImageNet with captions of the images that were shown."""
