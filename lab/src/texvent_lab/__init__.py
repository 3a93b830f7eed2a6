"""Laboratory of texvent: benchmarks, trained networks, and the measurements behind its pages."""
