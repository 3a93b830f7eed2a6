"""Triangle meshes in the ray caster: their trees, and where rays meet them."""
