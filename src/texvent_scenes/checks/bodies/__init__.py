"""Checks of bodies: acts, limbs, parts, lamps and looks."""
