"""Motion-compensated mixing of two frames: a definition in NumPy, and a compiled kernel."""
