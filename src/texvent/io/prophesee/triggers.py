"""External triggers in the words of EVT2, EVT2.1 and EVT3.

    EVT2    u32: 31..28 type 10 · 27..22 low time · 12..8 channel · 0 value
    EVT2.1  u64: the upper half is a word of EVT2, the lower half nothing
    EVT3    u16: 15..12 type 10 · 11..8 channel · 0 value; the time is that of the words before it

Source: Prophesee, "Data Encoding Formats" of the Metavision documentation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.io.block_writer import Columns

TIME_LOW, TIME_HIGH, TRIGGER = 6, 8, 10
Words: TypeAlias = bytes | memoryview | NDArray[Any]
"""Whole words, as stored in the file."""
Fields: TypeAlias = NDArray[np.int64]


@dataclass(frozen=True)
class TriggerCoding:
    """Places of the fields in a word; a field is (lowest bit, number of bits)."""

    word: str
    kind: tuple[int, int]
    high: tuple[int, int]
    """High bits of the time, in a word TIME_HIGH."""
    low: tuple[int, int] | None
    """Low bits of the time, in the trigger; None: in a word TIME_LOW before it."""
    channel: tuple[int, int]
    value: tuple[int, int]

    @property
    def low_bits(self) -> int:
        """Number of low bits of the time."""
        return self.low[1] if self.low is not None else self.high[1]


EVT2 = TriggerCoding("<u4", (28, 4), (0, 28), (22, 6), (8, 5), (0, 1))
EVT21 = replace(EVT2, word="<u8")
"""Layout of words whose upper half comes first."""
EVT3 = TriggerCoding("<u2", (12, 4), (0, 12), None, (8, 4), (0, 1))


def read_triggers(blocks: Iterable[Words], coding: TriggerCoding) -> Iterator[Columns]:
    """Columns t (µs), channel and value of the triggers in consecutive blocks of words."""
    from texvent.io.prophesee.time_high import FIRST_STATE, count_turns  # brings Numba

    state, high, low = np.array(FIRST_STATE), -1, 0
    for block in blocks:
        words = np.frombuffer(block, coding.word)
        kinds = field_of(words, coding.kind)
        chosen = np.isin(kinds, (TIME_LOW, TIME_HIGH, TRIGGER))
        words, kinds = words[chosen], kinds[chosen]
        highs = np.where(kinds == TIME_HIGH, field_of(words, coding.high), -1)
        highs = _forward(highs, high)
        before = np.concatenate([[high], highs[:-1]])
        turn = np.zeros_like(highs)
        count_turns(highs, state, coding.high[1], turn)
        if coding.low is None:
            # A new high time means its first µs until its low bits follow.
            lows = np.where(kinds == TIME_LOW, field_of(words, coding.high), -1)
            lows = np.where((kinds == TIME_HIGH) & (highs != before), 0, lows)
            lows = _forward(lows, low)
        else:
            lows = field_of(words, coding.low)
        here = (kinds == TRIGGER) & (highs >= 0)
        time = (turn << coding.high[1] | highs) << coding.low_bits | lows
        yield {
            "t": time[here],
            "channel": field_of(words, coding.channel)[here],
            "value": field_of(words, coding.value)[here],
        }
        if len(words):
            high, low = int(highs[-1]), int(lows[-1])


def field_of(words: NDArray[np.unsignedinteger], place: tuple[int, int]) -> Fields:
    """A field of words by its place: lowest bit, number of bits."""
    shift, bits = place
    return (words >> words.dtype.type(shift)).astype(np.int64) & ((1 << bits) - 1)


def _forward(values: Fields, first: int) -> Fields:
    """Values whose −1 are replaced by the last that is none."""
    places = np.where(values >= 0, np.arange(1, len(values) + 1), 0)
    return np.concatenate([[first], values])[np.maximum.accumulate(places)]
