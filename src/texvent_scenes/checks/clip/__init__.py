"""The staged clip as it is measured: boxes of bodies over time, and relations between them."""
