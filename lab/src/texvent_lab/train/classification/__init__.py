"""Classes of recordings: samples, networks, loss and accuracy."""
