"""Bodies that bend, step, wave or depend on the seed: their engine, and what needs code."""
