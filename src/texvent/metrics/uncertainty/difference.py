"""Differences between candidates on the same windows: how large, how sure, and that in words."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent.metrics.protocol import Better
from texvent.metrics.uncertainty.bootstrap import (
    LEAST_WINDOWS,
    Interval,
    average_blocks,
    bootstrap_interval,
    independent_block_size,
)
from texvent.metrics.uncertainty.permutation import sign_flip_p_values

SIGNIFICANCE = 0.05
"""Candidates are told apart where p is not above it."""

Key = TypeVar("Key", bound=Hashable)


@dataclass(frozen=True)
class Mean:
    """A mean of windows and its interval."""

    mean: float
    """NaN without a defined window."""
    interval: Interval
    """95 %; NaN where there are too few windows."""
    windows: int
    """Means that count as independent: windows, or blocks of them."""
    block: int = 1
    """Windows in each."""

    @classmethod
    def of(cls, values: ArrayLike, *, is_in_sequence: bool) -> Mean:
        """Of one value per window.

        Args:
            values: [n]; NaN is left out.
            is_in_sequence: the windows follow each other in time: neighbours that are alike are
                averaged (`independent_block_size`). False: seeds, scenes or recordings.
        """
        size = independent_block_size(values) if is_in_sequence else 1
        blocks = average_blocks(values, size)
        every = np.asarray(values, dtype=np.float64)
        defined = every[~np.isnan(every)]
        mean = float(defined.mean()) if len(defined) else math.nan
        count = int(np.count_nonzero(~np.isnan(blocks)))
        return cls(mean, bootstrap_interval(blocks), count, size)

    @property
    def is_enough(self) -> bool:
        """Whether there are windows enough to tell anything."""
        return self.windows >= LEAST_WINDOWS

    def document(self) -> dict[str, Any]:
        """Plain values, NaN where undefined."""
        return {
            "mean": self.mean,
            "low": self.interval.low,
            "high": self.interval.high,
            "windows": self.windows,
            "windows_per_block": self.block,
        }


@dataclass(frozen=True)
class Difference(Mean):
    """A mean of paired differences and its test."""

    p: float = math.nan
    """Two-sided, adjusted for all differences that were tested together; NaN: too few windows."""

    @property
    def is_told(self) -> bool:
        """Whether the two can be told apart."""
        return self.is_enough and self.p <= SIGNIFICANCE

    def document(self) -> dict[str, Any]:
        """Plain values, NaN where undefined."""
        return {**super().document(), "p": self.p, "is_told": self.is_told}

    def reversed(self) -> Difference:
        """The second candidate minus the first."""
        low, high = self.interval
        return Difference(-self.mean, Interval(-high, -low), self.windows, self.block, self.p)


class PairedDifferences(Generic[Key]):
    """Paired differences of one table, tested together."""

    def __init__(self, columns: Mapping[Key, ArrayLike], *, is_in_sequence: bool) -> None:
        """Test them.

        Args:
            columns: key → [n] differences, one per window, the same windows for all; NaN where one
                candidate is undefined.
            is_in_sequence: as in `Mean.of`.
        """
        self._columns = {key: np.asarray(one, np.float64) for key, one in columns.items()}
        self._is_in_sequence = is_in_sequence
        matrix = np.array(list(self._columns.values()))
        p_values: NDArray[np.float64] = np.full(len(matrix), math.nan)
        if len(matrix) and matrix.shape[1] >= LEAST_WINDOWS:
            p_values = sign_flip_p_values(matrix.T)
        self._p_values = dict(zip(self._columns, p_values.tolist(), strict=True))

    def __getitem__(self, key: Key) -> Difference:
        """One of them.

        Windows that follow each other count by blocks: p is the larger one of the table's test of
        windows and of the test of these blocks alone.
        """
        column = self._columns[key]
        found = Mean.of(column, is_in_sequence=self._is_in_sequence)
        p_value = math.nan
        if found.is_enough:
            p_value = self._p_values[key]
            if found.block > 1:
                blocks = average_blocks(column, found.block)
                p_value = max(p_value, float(sign_flip_p_values(blocks[:, None])[0]))
        return Difference(found.mean, found.interval, found.windows, found.block, p_value)


def differences_from(
    baseline: str, values: Mapping[str, ArrayLike], *, is_in_sequence: bool
) -> PairedDifferences[str]:
    """Every other candidate of a table against one: candidate → its value minus the baseline's.

    Args:
        baseline: the one. It may be the best of these values: the test holds for all others at
            once, as in J. Hsu's multiple comparisons with the best (1984).
        values: candidate → [n] values on the same windows.
        is_in_sequence: as in `Mean.of`.
    """
    known = {name: np.asarray(one, np.float64) for name, one in values.items()}
    columns = {name: one - known[baseline] for name, one in known.items() if name != baseline}
    return PairedDifferences(columns, is_in_sequence=is_in_sequence)


def tell(
    first: str, second: str, difference: Difference, *, better: Better = "lower", unit: str = ""
) -> str:
    """A sentence that says which of two candidates is closer to the reference.

    Args:
        first: name of the one candidate.
        second: name of the other.
        difference: of their values, first minus second.
        better: "higher" where larger values are closer.
        unit: of the values.

    Example:
        >>> tell("A", "B", Difference(0.036, Interval(0.031, 0.042), 8, p=0.008), better="higher")
        'A is closer than B by 0.036 (95 % interval 0.031 to 0.042, 8 windows)'
    """
    if not difference.is_enough:
        kind = "windows" if difference.block == 1 else "independent windows"
        return (
            f"{first} and {second}: too few {kind} to tell (n = {difference.windows}; "
            f"{LEAST_WINDOWS} are needed)"
        )
    is_first = (difference.mean > 0) == (better == "higher")
    if difference.is_told and difference.mean < 0:
        difference = difference.reversed()
    digits = _digits(difference)
    mean, low, high = (f"{one:.{digits}f}" for one in (difference.mean, *difference.interval))
    count = f"{difference.windows} windows"
    if difference.block > 1:
        count = f"{difference.windows} blocks of {difference.block} windows"
    if not difference.is_told:
        return (
            f"{first} and {second} cannot be told apart (difference {mean}, 95 % interval {low} to "
            f"{high}, p = {difference.p:.2g}, {count})"
        )
    closer, other = (first, second) if is_first else (second, first)
    by = f"{mean} {unit}".strip()
    return f"{closer} is closer than {other} by {by} (95 % interval {low} to {high}, {count})"


def _digits(difference: Difference) -> int:
    """Digits after the point: two that count of the larger end, at least three, at most six."""
    largest = max(map(abs, (difference.mean, *difference.interval)))
    if not largest > 0:
        return 3
    return min(max(1 - math.floor(math.log10(largest)), 3), 6)
