"""Stage 1, prompt → video: text-to-video generators behind one protocol."""
