"""Prophesee words decoded one by one, written from the published tables; slow and plain."""

import struct

Event = tuple[int, int, int, int]
"""x, y, t, p."""


def decode_evt2(data: bytes) -> list[Event]:
    events: list[Event] = []
    high = None
    for (word,) in struct.iter_unpack("<I", data):
        kind = word >> 28
        if kind == 0b1000:
            high = word & 0x0FFFFFFF
        elif kind in (0, 1) and high is not None:
            low = (word >> 22) & 0b111111
            events.append(((word >> 11) & 2047, word & 2047, high * 64 + low, kind))
    return events


def decode_evt21(data: bytes) -> list[Event]:
    events: list[Event] = []
    high = None
    for valid, upper in struct.iter_unpack("<II", data):
        kind = upper >> 28
        if kind == 0b1000:
            high = upper & 0x0FFFFFFF
        elif kind in (0, 1) and high is not None:
            t = high * 64 + ((upper >> 22) & 0b111111)
            column, y = (upper >> 11) & 2047, upper & 2047
            events += [(column + i, y, t, kind) for i in range(32) if valid & (1 << i)]
    return events


def decode_evt3(data: bytes) -> list[Event]:
    events: list[Event] = []
    high, low, turns, y, base, sign = None, 0, 0, None, 0, 0
    highs: list[int] = []
    for (word,) in struct.iter_unpack("<H", data):
        kind, value = word >> 12, word & 0xFFF
        if kind in (0b0000, 0b0001):
            y = value & 2047 if kind == 0 else None
        elif kind == 0b0011:
            base, sign = value & 2047, value >> 11
        elif kind == 0b0110:
            low = value
        elif kind == 0b1000:
            if value != high:
                highs, low, high = [*highs, value], 0, value
                turns = count_turns(highs)
        elif kind in (0b0010, 0b0100, 0b0101):
            found = [(value & 2047, value >> 11)]
            if kind != 0b0010:
                width = 12 if kind == 0b0100 else 8
                found = [(base + i, sign) for i in range(width) if value & (1 << i)]
                base += width
            if high is not None and y is not None:
                t = turns * 2**24 + high * 4096 + low
                events += [(x, y, t, p) for x, p in found]
    return events


def decode_dat(data: bytes) -> list[Event]:
    return [
        (place & 0x3FFF, (place >> 14) & 0x3FFF, t, place >> 28)
        for t, place in struct.iter_unpack("<II", data)
    ]


def count_turns(highs: list[int]) -> int:
    """Turns up to the last of the values of a counter of 12 bits, none like that before it."""
    if len(highs) < 2:
        return 0
    *earlier, high, value = highs
    is_jump = 3840 <= abs(value - high) < 4095 and high != 4095
    if earlier and is_jump and abs(high - earlier[-1]) >= 3840 and 0 <= value - earlier[-1] < 256:
        return count_turns(earlier)  # a lone wrong value is between
    return count_turns([*earlier, high]) + (high - value >= 3840)
