"""Events from a video model's latents, without its frames. Experimental; see docs/latents.md."""
