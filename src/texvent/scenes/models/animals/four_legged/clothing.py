"""Animals wear nothing: kept for staging's callers until these are gone."""

from __future__ import annotations

from collections.abc import Iterable

from texvent.scenes.models.protocol import Model, Noun

TRUNK_CLOTHES: frozenset[str] = frozenset()


def wears_on_trunk(noun: Noun, garment: str) -> bool:
    """Never."""
    return False


def clothe(noun: Noun, worn: Iterable[object]) -> Noun:
    """The noun as it is."""
    return noun


def share_of_head(model: Model) -> float:
    """As large as a person's."""
    return 1.0


def has_fitting_head(noun: Noun) -> bool:
    """Never."""
    return False
