"""Numbers of clips of specifications."""

from __future__ import annotations

import dataclasses

from texvent.dataset.specification.items import read_items
from texvent.dataset.specification.specification import Specification


def with_count(specification: Specification, clips: int | None) -> Specification:
    """The specification with so many clips in all, in equal shares of its scene files."""
    if clips is None:
        return specification

    def shared(count: int) -> Specification:
        sources = [dataclasses.replace(one, count=count) for one in specification.sources]
        return dataclasses.replace(specification, sources=tuple(sources))

    return shared(max(1, clips // len(read_items(shared(1)).all)))
