"""Events from the latents of a video autoencoder, against events from its frames."""
