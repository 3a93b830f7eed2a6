"""EVT2 in RAW files: words of 32 bits, little-endian.

    bits 31..28   type: 0 OFF, 1 ON, 8 TIME_HIGH; others (10 trigger, 14, 15) are skipped
    OFF, ON       27..22 low 6 bits of t (µs) · 21..11 x · 10..0 y
    TIME_HIGH     27..0  t >> 6

Coordinates below 2048, times below 2^34 µs (4 h 46 min). Readers disagree on what follows when
the counter wraps, so texvent does not write later times; it reads wrapped files. A TIME_HIGH word
is written when its value changes.

Source: Prophesee, "EVT 2.0 Format".
"""

from __future__ import annotations

from typing import ClassVar

from texvent.io.limits import FormatLimits
from texvent.io.prophesee.evt import MAX_SIDE, EvtCodec
from texvent.io.prophesee.word_coding import WordKernels


class Evt2Codec(EvtCodec):
    """RAW files of EVT2."""

    name: ClassVar[str] = "evt2"
    title: ClassVar[str] = "EVT2"
    version: ClassVar[str] = "2.0"
    word_bytes: ClassVar[int] = 4
    limits: ClassVar[FormatLimits] = FormatLimits("EVT2", MAX_SIDE, 1 << 34)

    def kernels(self) -> WordKernels:
        """The compiled loops of EVT2."""
        from texvent.io.prophesee import evt2_coding  # brings Numba

        return evt2_coding
