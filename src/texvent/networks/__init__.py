"""Files of published networks: their tensors, and the shapes that a network must have."""
