"""Things that move otherwise than their surroundings: small fast ones, and the outlines of all."""
