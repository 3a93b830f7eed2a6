"""What happens to bytes: each function makes a damaged copy of a file's content."""

import random
from collections.abc import Callable

Damage = Callable[[random.Random, bytes], bytes]

ABSURD = (
    b"\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\x00\x00\x00\x80",
    b"\xff\xff\xff\xff\xff\xff\xff\x7f",
    bytes(8),
    b"\xff\xff",
)
"""Lengths and offsets that no small file has."""


def flip_bits(rng: random.Random, content: bytes) -> bytes:
    """Flip one to eight bits."""
    changed = bytearray(content)
    for _ in range(rng.randint(1, 8) if changed else 0):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def flip_early_bits(rng: random.Random, content: bytes) -> bytes:
    """Flip bits of the first 200 bytes, where headers lie."""
    return flip_bits(rng, content[:200]) + content[200:]


def truncate(rng: random.Random, content: bytes) -> bytes:
    """Cut the end off."""
    return content[: rng.randrange(len(content) + 1)]


def splice(rng: random.Random, content: bytes) -> bytes:
    """Overwrite a part by another part."""
    start, stop = _range(rng, content)
    place = rng.randrange(len(content) + 1)
    return content[:place] + content[start:stop] + content[place + stop - start :]


def repeat_block(rng: random.Random, content: bytes) -> bytes:
    """Repeat a part up to 200 times."""
    start, stop = _range(rng, content, most=2000)
    return content[:stop] + content[start:stop] * rng.randint(1, 200) + content[stop:]


def zero_range(rng: random.Random, content: bytes) -> bytes:
    """Overwrite a part by NUL bytes."""
    start, stop = _range(rng, content)
    return content[:start] + bytes(stop - start) + content[stop:]


def write_absurd_number(rng: random.Random, content: bytes) -> bytes:
    """Overwrite a few bytes by a huge or negative number."""
    number = rng.choice(ABSURD)
    start = rng.randrange(len(content) + 1)
    return content[:start] + number + content[start + len(number) :]


def write_absurd_header(rng: random.Random, content: bytes) -> bytes:
    """The same in the first 200 bytes."""
    return write_absurd_number(rng, content[:200]) + content[200:]


def cut_out(rng: random.Random, content: bytes) -> bytes:
    """Leave a part out."""
    start, stop = _range(rng, content)
    return content[:start] + content[stop:]


def end_in_noise(rng: random.Random, content: bytes) -> bytes:
    """Random bytes after a sound beginning."""
    return content[: rng.randrange(len(content) + 1)] + rng.randbytes(rng.randint(1, 600))


def insert_hostile_bytes(rng: random.Random, content: bytes) -> bytes:
    """NUL, bytes that are no UTF-8, line ends, byte-order marks."""
    odd = rng.choice((b"\0", b"\xff\xfe", b"\xc3", b"\r", b"\n\n\n", b"\xef\xbb\xbf", b"\x1a"))
    start = rng.randrange(len(content) + 1)
    return content[:start] + odd + content[start:]


def nudge_byte(rng: random.Random, content: bytes) -> bytes:
    """Make one byte one more or one less, every other time of the first 200."""
    if not content:
        return content
    at, by = rng.randrange(rng.choice((min(200, len(content)), len(content)))), rng.choice((1, 255))
    return content[:at] + bytes([(content[at] + by) % 256]) + content[at + 1 :]


def _range(rng: random.Random, content: bytes, most: int = 10_000) -> tuple[int, int]:
    start = rng.randrange(len(content) + 1)
    return start, min(len(content), start + rng.randint(1, most))


BYTE_DAMAGE: tuple[Damage, ...] = (
    flip_bits,
    flip_early_bits,
    truncate,
    splice,
    repeat_block,
    zero_range,
    write_absurd_number,
    write_absurd_header,
    cut_out,
    end_in_noise,
    insert_hostile_bytes,
)
