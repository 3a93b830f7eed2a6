"""All readers by name."""

from __future__ import annotations

import functools

from .document_readers import document_readers
from .event_readers import event_readers
from .frame_readers import frame_readers
from .motion_readers import motion_readers
from .reader import Reader
from .text_readers import text_readers


@functools.cache
def readers() -> dict[str, Reader]:
    """Name → reader, in the table's order."""
    pictures = [*frame_readers(), *motion_readers()]
    found = [*event_readers(), *pictures, *text_readers(), *document_readers()]
    return {reader.name: reader for reader in found}
