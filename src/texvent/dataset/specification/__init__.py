"""Specification of a data set: a file, or a Python object, that decides every sample."""
