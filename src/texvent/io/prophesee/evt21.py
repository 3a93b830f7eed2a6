"""EVT2.1 in RAW files: words of 64 bits for up to 32 events each.

    bits 63..60   type: 0 OFF, 1 ON, 8 TIME_HIGH; others are skipped
    OFF, ON       59..54 low 6 bits of t (µs) · 53..43 first x, a multiple of 32 · 42..32 y
                  31..0  bit i set: an event at x + i
    TIME_HIGH     59..32 t >> 6

Coordinates below 2048, times below 2^34 µs (4 h 46 min), as EVT2. Consecutive events of one time,
row and polarity whose x rises share a word; the order of events is kept.

The words come in one of two orders of bytes, as the header says: `endianness=little`, plain, or
`endianness=legacy`, upper half first (each half little-endian), as the IMX636 sends them. texvent
reads both and writes legacy, which more readers know. Where nothing is stated, cameras of
Prophesee with a system number below 0x37 count as legacy, the others as little, as in OpenEB.

Source: Prophesee, "EVT 2.1 Format".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from texvent.io.limits import FormatLimits
from texvent.io.prophesee.evt import INTEGRATOR, MAX_SIDE, EvtCodec
from texvent.io.prophesee.text_header import TextHeader
from texvent.io.prophesee.word_coding import WordDecoder, WordKernels, Words
from texvent.io.protocol import Columns

LEGACY = "legacy"
FIRST_LITTLE_SYSTEM = 0x37


class Evt21Codec(EvtCodec):
    """RAW files of EVT2.1."""

    name: ClassVar[str] = "evt21"
    title: ClassVar[str] = "EVT21"
    version: ClassVar[str] = "2.1"
    word_bytes: ClassVar[int] = 8
    limits: ClassVar[FormatLimits] = FormatLimits("EVT2.1", MAX_SIDE, 1 << 34)
    options: ClassVar[Mapping[str, str]] = {"endianness": LEGACY}

    def kernels(self) -> WordKernels:
        """The compiled loops of EVT2.1."""
        from texvent.io.prophesee import evt21_coding  # brings Numba

        return evt21_coding

    def make_decoder(self, header: TextHeader | None = None) -> WordDecoder:
        """A decoder for a file with this header: it may have to exchange the halves of words."""
        kind = WordDecoder if header is None or is_legacy(header) else LittleDecoder
        return kind(self.kernels())


class LittleDecoder(WordDecoder):
    """Decodes words whose lower half comes first."""

    def decode(self, words: Words) -> Columns:
        """Columns x, y, t, p of the events in these words."""
        numbers = np.frombuffer(words, "<u8")
        return super().decode(numbers << 32 | numbers >> 32)


def is_legacy(header: TextHeader) -> bool:
    """True if the header says, or its camera implies, that the upper half of a word comes first."""
    stated = header.options()[1].get("endianness", header.fields.get("endianness"))
    if stated is not None:
        return stated == LEGACY
    system = header.fields.get("system_ID", "")
    maker = header.fields.get("plugin_integrator_name", header.fields.get("integrator_name"))
    known = system.isdecimal() and len(system) < 9
    return known and maker in (None, INTEGRATOR) and 0 < int(system) < FIRST_LITTLE_SYSTEM
