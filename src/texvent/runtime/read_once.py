"""Sources that can be read once: generators, cameras, pipes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Generic, TypeVar

from texvent.errors import InputError

Item = TypeVar("Item")


class ReadOnce(Generic[Item]):
    """Items of an iterable whose second pass is refused, however far the first one went.

    A second pass would begin where the first one stopped, and give other events without a word.

    Args:
        items: what is read.
        name: how the error calls it, such as "a generator of frames".

    Example:
        >>> once = ReadOnce((i for i in range(3)), "a generator of numbers")
        >>> next(iter(once))
        0
        >>> iter(once)  # doctest: +ELLIPSIS
        Traceback (most recent call last):
        texvent.errors.InputError: a generator of numbers can be read once, and was; ...
    """

    def __init__(self, items: Iterable[Item], name: str) -> None:
        self._items = items
        self._name = name
        self._is_begun = False

    def __iter__(self) -> Iterator[Item]:
        """The items.

        Raises:
            InputError: they were asked for before.
        """
        if self._is_begun:
            raise InputError(
                f"{self._name} can be read once, and was; open or make it again, give a list, an "
                "array or a file instead, or keep the events of one pass: collect() or save()"
            )
        self._is_begun = True
        return iter(self._items)
