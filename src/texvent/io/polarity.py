"""Polarity as other programs write it: 0/1, -1/+1, 0/255, 1/2 or words, as 0 = OFF and 1 = ON.

One value has two meanings in two codes (1 is OFF beside 2), so the values of a whole column decide.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, few, shown, warn

CODES = ((0, 1), (-1, 1), (0, 255), (1, 2))
"""Values of OFF and ON; values that fit several codes mean the same in the first."""
AMBIGUOUS = ({255}, {2})
"""Values that do not say what they mean without another beside them."""
WORDS = {
    **{"on": 1, "true": 1, "pos": 1, "positive": 1, "+": 1},
    **{"off": 0, "false": 0, "neg": 0, "negative": 0, "-": 0},
}
"""Word in lower case → number."""
ALLOWED = "0/1, -1/+1, 0/255, 1/2, true/false, on/off or +/- (OFF/ON)"


class PolarityCode:
    """The code of a column, found by the values of a sample and held against all that follow.

    Args:
        path: the file, for messages.
        sample: values from all over the column.
        is_repaired: whether values of the sample that are of no code are left out.

    Raises:
        FileFormatError: the values are of no code, or of several that contradict each other.
    """

    def __init__(self, path: Path, sample: NDArray[Any], *, is_repaired: bool = False) -> None:
        self._path = path
        self._seen: set[float] = set()
        self._off: float = 0
        self.binary(sample[self.are_likely(sample)] if is_repaired else sample)
        if self._off == 1:
            warn(f"{path}: its polarities 1 and 2 are read as OFF and ON")

    def binary(self, values: NDArray[Any]) -> NDArray[np.uint8]:
        """Values as 0 = OFF and 1 = ON.

        Raises:
            FileFormatError: they do not fit the code, or the values before.
        """
        numbers = _numbers(values)
        if values.dtype.kind in "OSU" and np.isnan(numbers).any():
            raise self._error(np.unique(values.astype("U16")).tolist())
        is_one = numbers == 1
        ones = int(np.count_nonzero(is_one))
        if ones + np.count_nonzero(numbers == 0) == len(numbers):
            found: set[float] = {1} if ones == len(numbers) else {0, 1} if ones else {0}
        else:
            found = set(np.unique(numbers).tolist())
        seen = self._seen | (found if len(numbers) else set())
        off, on = next((code for code in CODES if seen <= {*code}), (None, None))
        was_on = 1 in self._seen and self._off != 1
        if off is None or seen in AMBIGUOUS or (was_on and off == 1):
            raise self._error(sorted(seen, key=str))
        self._seen, self._off = seen, off
        is_on: NDArray[np.bool_] = is_one if on == 1 else numbers == on
        return is_on.astype(np.uint8)

    def are_likely(self, values: NDArray[Any]) -> NDArray[np.bool_]:
        """Mask of values of the code that fits the values before, and most of these."""
        numbers = _numbers(values)
        fits = [np.isin(numbers, code) for code in CODES if self._seen <= {*code}]
        return np.asarray(max(fits, key=np.count_nonzero))

    def _error(self, held: list[Any]) -> FileFormatError:
        listed = few([shown(one) for one in held], 4)
        return FileFormatError(f"{self._path}: polarity holds {listed}; it must be {ALLOWED}")


def _numbers(values: NDArray[Any]) -> NDArray[Any]:
    """Values as numbers; NaN for words that are none."""
    if values.dtype.kind not in "OSU":
        return values
    texts, places = np.unique(values.astype("U16"), return_inverse=True)
    return np.array([number_of(text.strip()) for text in texts.tolist()], float)[places]


def number_of(word: str) -> float:
    """A word of polarity, or a number, as a number; NaN of others."""
    try:
        return float(WORDS.get(word.lower(), word))
    except ValueError:
        return float("nan")
