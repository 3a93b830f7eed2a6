"""The self-test of the metrics: which perturbation does each one see?"""
