"""How much of a property or of a table is tried: in a brief run, a share of the whole."""

from typing import Any

from hypothesis import settings


def share() -> float:
    """Examples of the profile for each example of an ordinary run."""
    return settings.default.max_examples / settings.get_profile("quick").max_examples


def one_of() -> int:
    """Of how many rows of a table, or states of a run, one is tried; a whole run tries all."""
    return max(1, round(1 / share()))


def examples(count: int, **options: Any) -> settings:
    """Settings of a property with so many examples in an ordinary run."""
    return settings(max_examples=max(3, round(count * share())), **options)
