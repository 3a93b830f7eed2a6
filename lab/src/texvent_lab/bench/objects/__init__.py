"""Networks trained on simulated events of household objects, tested on recorded ones."""
