"""The ray caster: kernels compiled by Numba, and the arrays they read."""
