"""Drawing: RGB images, palettes, panels and annotations."""
