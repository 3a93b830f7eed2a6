"""Identity of a sample: a digest of its subject, and a seed derived from it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence


def digest(values: Sequence[object]) -> str:
    """128 bits of a list of plain values, as 32 hexadecimal digits."""
    text = json.dumps(values).encode()
    return hashlib.blake2b(text, digest_size=16).hexdigest()


def derived_seed(*values: object) -> int:
    """A seed, 0..2⁶³−1, that depends on the values alone."""
    return int(digest(values), 16) & (2**63 - 1)
