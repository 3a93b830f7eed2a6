"""Random draws keyed by (seed, frame, y, x): mismatch, noise rates, Poisson arrivals."""
