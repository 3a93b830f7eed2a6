"""The embedded generator: a prompt becomes an animated 3-D scene with exact ground truth."""
