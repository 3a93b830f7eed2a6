"""Tiny decoders of video models' latents, in the published layout of TAEHV."""
