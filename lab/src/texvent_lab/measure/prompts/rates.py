"""Shares with their intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass

Z95 = 1.959964
"""Standard normal quantile of .975."""


@dataclass(frozen=True)
class Share:
    """How many of how many.

    Example:
        >>> str(Share(8, 10)), str(Share(0, 0))
        ('80 % (49 to 94; 8 of 10)', '-')
    """

    count: float
    of: int

    @property
    def value(self) -> float:
        """The share, 0..1; NaN of nothing."""
        return self.count / self.of if self.of else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval at 95 %: E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927)."""
        if not self.of:
            return math.nan, math.nan
        share, weight = self.value, Z95**2 / self.of
        middle = (share + weight / 2) / (1 + weight)
        half = math.sqrt(share * (1 - share) * weight + weight**2 / 4) / (1 + weight)
        return max(0.0, middle - half), min(1.0, middle + half)

    @property
    def tables(self) -> dict[str, float | int | list[float] | None]:
        """Plain values, ready for JSON."""
        return {
            "count": self.count,
            "of": self.of,
            "share": round(self.value, 4) if self.of else None,
            "interval": [round(end, 4) for end in self.interval] if self.of else None,
        }

    def __str__(self) -> str:
        if not self.of:
            return "-"
        low, high = self.interval
        return (
            f"{100 * self.value:.0f} % ({100 * low:.0f} to {100 * high:.0f}; "
            f"{self.count:g} of {self.of})"
        )
