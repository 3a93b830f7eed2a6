"""The ray caster: scenes of solids to luma, depth, ids and flow, bit for bit reproducible."""
