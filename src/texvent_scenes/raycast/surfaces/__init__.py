"""Materials as small tiles that repeat without a seam, with all their blurred versions."""
