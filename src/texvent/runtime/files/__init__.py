"""Files: their names, locks and cache, and opening of images, videos and YAML."""
