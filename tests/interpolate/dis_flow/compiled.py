"""The compiled kernels, under the names of the functions in `reference`."""

from texvent.interpolate.dis_flow.estimator import double, halve, make_level
from texvent.interpolate.dis_flow.refine import change_along, refine, unconfirmed
from texvent.interpolate.dis_flow.search import join, search, try_vectors

__all__ = [
    "change_along",
    "double",
    "halve",
    "join",
    "make_level",
    "refine",
    "search",
    "try_vectors",
    "unconfirmed",
]
