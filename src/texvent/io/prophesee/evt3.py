"""EVT3 in RAW files: words of 16 bits, little-endian; each tells only what changes.

    bits 15..12   type; value in bits 11..0
     0 ADDR_Y       row of the events that follow, bits 10..0
     2 ADDR_X       one event: polarity bit 11, column bits 10..0
     3 VECT_BASE_X  polarity and column of the next vector word
     4 VECT_12      bit i set: an event at base + i; then base += 12
     5 VECT_8       the same with 8 bits
     6 TIME_LOW     low 12 bits of t (µs)
     8 TIME_HIGH    next 12 bits of t; a new value sets the low bits to 0
     1              row of events of another kind, skipped until the next ADDR_Y
     others         triggers and continuations, skipped

Coordinates below 2048. The counter wraps every 2^24 µs (16.78 s): a fall of TIME_HIGH by 2048 or
more is a wrap. texvent writes the last and the first value of every turn that a silence spans, so
long silences survive. Times below 2^42 µs (51 days): beyond, that padding would pass 1 MB.

Every event is written as ADDR_X: OpenEB loses events in vector words that do not come as
12 + 12 + 8. A new time repeats the row, as the cameras do.

Source: Prophesee, "EVT 3.0 Format".
"""

from __future__ import annotations

from typing import ClassVar

from texvent.io.limits import FormatLimits
from texvent.io.prophesee.evt import MAX_SIDE, EvtCodec
from texvent.io.prophesee.word_coding import WordKernels


class Evt3Codec(EvtCodec):
    """RAW files of EVT3."""

    name: ClassVar[str] = "evt3"
    title: ClassVar[str] = "EVT3"
    version: ClassVar[str] = "3.0"
    word_bytes: ClassVar[int] = 2
    limits: ClassVar[FormatLimits] = FormatLimits("EVT3", MAX_SIDE, 1 << 42)

    def kernels(self) -> WordKernels:
        """The compiled loops of EVT3."""
        from texvent.io.prophesee import evt3_coding  # brings Numba

        return evt3_coding
