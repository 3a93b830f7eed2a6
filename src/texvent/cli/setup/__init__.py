"""Commands about what is installed: data, weights, generators, doctor."""
