"""MNIST, N-MNIST, how its sensor moved, digits that move so, and what networks see of them."""
