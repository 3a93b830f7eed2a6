"""DVS-Voltmeter: first passages of Brownian motion with drift."""
