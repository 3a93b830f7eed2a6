"""Names of places, until the table of places has them."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.language.vocabulary.scene import PLACES
from texvent.scenes.read.kept import kept


def place_names() -> Mapping[str, tuple[str, ...]]:
    """Place → its names."""
    return kept("places", PLACES)
