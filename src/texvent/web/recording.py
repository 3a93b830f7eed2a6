"""Recording of live events: an event file, and until it is complete, a copy that survives a kill.

Every event is in the copy as soon as it is shown: an array (.npy) whose header is right at any
moment, with sensor and metadata beside it. It is removed when the event file has its name.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import OutputError
from texvent.events import EventStream
from texvent.io.arrays.npy_file import growing_array
from texvent.io.files import open_writer
from texvent.io.metadata import sidecar_path, sidecar_text
from texvent.sensor import SensorSize

COPY = ".unfinished.npy"
"""End of the name of the copy: `live.h5.unfinished.npy`."""
RECORD = np.dtype([("x", "<u2"), ("y", "<u2"), ("p", "u1"), ("t_us", "<i8")])


class LiveRecording:
    """A recording that has begun.

    Args:
        path: the event file.
        size: sensor.
        metadata: stored with the events.
        format: of the event file.
        start_us: time that is 0 in the file.

    Raises:
        ConfigError, OutputError: as `open_writer`; or there is a copy of an earlier recording.
    """

    def __init__(
        self,
        path: Path,
        *,
        size: SensorSize,
        metadata: Mapping[str, Any],
        format: str,
        start_us: int,
    ) -> None:
        self.path, self.copy = path, path.with_name(f"{path.name}{COPY}")
        self._start_us = start_us
        if path.exists():
            raise OutputError(f"{path} exists already; choose another name")
        if self.copy.exists():
            raise OutputError(
                f"{self.copy} holds a recording that broke off; keep it by texvent convert "
                f"{self.copy} NAME, or choose another name"
            )
        with ExitStack() as stack:
            writer = open_writer(path, size=size, metadata=metadata, format=format)
            self._writer = stack.enter_context(writer)
            self._append = stack.enter_context(growing_array(self.copy, dtype=RECORD, is_live=True))
            sidecar_path(self.copy).write_text(sidecar_text(size, metadata), encoding="utf-8")
            self._ended = stack.pop_all()

    def append(self, events: EventStream) -> None:
        """Add events.

        Raises:
            TexventError, OSError: as `BlockWriter.append`.
        """
        if len(events):
            since_start = events.t - self._start_us
            columns: list[NDArray[Any]] = [events.x, events.y, events.p, since_start]
            self._append(np.rec.fromarrays(columns, dtype=RECORD))
            self._writer.append(replace(events, t=since_start))

    def close(self, facts: Mapping[str, Any], *raised: Any) -> None:
        """Complete the event file with more metadata; after an error, keep the copy instead.

        Raises:
            TexventError, OSError: the event file cannot be completed; the copy is kept.
        """
        if facts:
            self._writer.add_metadata(facts)
        self._ended.__exit__(*raised)
        if raised[0] is None:
            self.copy.unlink()
            sidecar_path(self.copy).unlink()
