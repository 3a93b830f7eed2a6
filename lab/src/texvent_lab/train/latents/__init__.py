"""A head on a video autoencoder's latents, trained on scenes. Experimental; see docs/latents.md."""
