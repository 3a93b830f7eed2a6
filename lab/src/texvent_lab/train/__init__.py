"""Networks trained on events: simulated while they train, or read from stored data sets."""
