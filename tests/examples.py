"""How much of a property or of a table is tried: in a brief run, a share of the whole."""

from typing import Any

from hypothesis import settings


def share() -> float:
    """Examples of the profile for each example of an ordinary run."""
    return settings.default.max_examples / settings.get_profile("quick").max_examples


MOST = 48
"""Rows of a table that a test without rows of its own tries in a brief run."""


def one_of(rows: int = 0) -> int:
    """Of how many rows of a table, or states of a run, one is tried; a whole run tries all."""
    step = max(1, round(1 / share()))
    return step if step == 1 else max(step, -(-rows // MOST))


def examples(count: int, **options: Any) -> settings:
    """Settings of a property with so many examples in an ordinary run."""
    return settings(max_examples=max(3, round(count * share())), **options)
