"""Patterns that turn their face straight to the camera."""

from __future__ import annotations

FACING = frozenset(
    {"april tag", "bar", "barcode", "circle grid", "digit", "disc", "expanding ring", "grating",
     "letter", "qr code", "random dots", "spinning disc", "vertical edge"}
)  # fmt: skip
"""Names of these nouns."""
