"""Interface of metrics, and the check of a pair of streams."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

from texvent.errors import InputError
from texvent.events import EventStream

Better: TypeAlias = Literal["lower", "higher", "one"]
"""Direction of good values: low, high, or close to 1."""

UNDEFINED = float("nan")
"""Value of a metric that the two streams do not define."""


@dataclass(frozen=True, kw_only=True)
class Metric(ABC):
    """Compares two event streams of one sensor; built without arguments it has its defaults.

    A metric's parameters are fields, its facts class attributes; it computes its value in `_score`.
    """

    name: ClassVar[str]
    """Short name, as in the registry."""
    unit: ClassVar[str] = ""
    """Unit of the value; empty for a pure number."""
    better: ClassVar[Better] = "lower"
    range: ClassVar[tuple[float, float]] = (0.0, 1.0)
    """Smallest and largest value possible."""
    blind_to: ClassVar[str]
    """Differences that this metric does not see, for the reader of a table."""

    def __call__(self, predicted: EventStream, reference: EventStream) -> float:
        """Score of `predicted`.

        Args:
            predicted: the stream to judge.
            reference: the true stream, or another recording of the same scene.

        Returns:
            The value, or NaN where the two streams do not define one.

        Raises:
            InputError: the sensors differ in size, or weights that the metric needs are not here.
        """
        check_pair(predicted, reference)
        return self._score(predicted, reference)

    def missing(self) -> str | None:
        """Missing requirement of this metric, such as network weights; None if nothing is missing.

        Such a metric is left out of `compare` unless it is named.
        """
        return None

    @abstractmethod
    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        """The value for two streams of the same size."""


def check_pair(predicted: EventStream, reference: EventStream) -> None:
    """Refuse streams that no paired metric can compare.

    Raises:
        InputError: the sensors differ in size.
    """
    if predicted.size != reference.size:
        raise InputError(
            f"cannot compare a {predicted.size} sensor with a {reference.size} one; "
            "simulate at the size of the reference, or crop both to a common size"
        )
