"""Page of `texvent live`: a camera beside its events."""

from __future__ import annotations

import base64
import contextlib
import json
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from texvent._registry import SIMULATORS
from texvent.errors import InputError
from texvent.io.files import extension_of, writable_formats
from texvent.represent.event_frame import event_frame
from texvent.runtime.files.file_names import inside
from texvent.view.drawing.canvas import jpeg_bytes, png_bytes, shrink
from texvent.view.drawing.event_image import draw_events, frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, PALETTES
from texvent.web.live import LiveEvents, Shown
from texvent.web.server import Answer, PageServer, page_text

WAIT_S = 1.0
"""Wait of a request for the next frame, s."""
GRACE_S, SILENCE_S = 2.0, 60.0
"""Time for which a page may ask for nothing after it said that it closes, and at any time, s."""
PICTURE_WIDTH = 960
"""Widest picture of the camera, pixels."""


class LiveServer(PageServer):
    """The page of a live source; it asks for the next frame when it has drawn the last one.

    Args:
        live: the events, which end with the server.
        name: of the source.
        folder: recordings lie in it, or in folders of it.
        port: TCP port; 0: any free one.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, live: LiveEvents, name: str, folder: Path, *, port: int = 0) -> None:
        self._live = live
        self._asked_s = self._left_s = 0.0
        formats = {one: extension_of(one) for one in writable_formats()}
        choices = {"source": name, "simulators": SIMULATORS.names(), "formats": formats}
        posts = {
            "/change": lambda values: live.change(values["simulator"], values["threshold"]),
            "/record": lambda values: live.record(inside(folder, values["file"]), values["format"]),
            "/stop": lambda values: live.stop_recording(),
            "/leave": self._leave,
        }
        text = page_text("live_page.html", choices)
        try:
            super().__init__(text, {"/next": self._next}, posts, port=port)
        except InputError:
            live.close()
            raise

    def is_over(self) -> bool:
        """Whether the page was closed, and not opened again."""
        silence_s = time.monotonic() - max(self._left_s, self._asked_s)
        return self._asked_s > 0.0 and silence_s > (GRACE_S if self._left_s else SILENCE_S)

    def close(self) -> None:
        """Stop the server and complete the recording; errors as `LiveEvents.close`."""
        super().close()
        self._live.close()

    def _leave(self, values: Mapping[str, Any]) -> None:
        self._left_s = time.monotonic()

    def _next(self, query: Mapping[str, str]) -> Answer:
        """The state, with pictures if a frame has come that is not drawn yet."""
        self._asked_s = time.monotonic()
        if self._asked_s - self._left_s > GRACE_S:
            self._left_s = 0.0  # it was loaded again, or is open twice
        arrived_s = _number(query, "arrived_s", 0.0)
        if arrived_s:
            self._live.note_drawn(arrived_s)
        frame = self._live.wait(_number(query, "drawn_us", -1.0), WAIT_S)
        pictures = {} if frame is None else self._pictures(frame, is_dark="dark" in query)
        return Answer(json.dumps({**self._live.describe(), **pictures}))

    def _pictures(self, one: Shown, *, is_dark: bool) -> dict[str, Any]:
        seen = frame_image(replace(one.frame, pixels=self._live.picture(one)))
        camera = jpeg_bytes(shrink(seen, PICTURE_WIDTH), quality=85)
        palette = PALETTES[DEFAULT_PALETTE]
        events = draw_events(event_frame(one.events, "count"), palette.dark if is_dark else palette)
        return {
            "t_us": one.frame.t_us,
            "source_us": one.source_us,
            "arrived_s": one.arrived_s,
            "events": len(one.events),
            "camera_jpeg": base64.b64encode(camera).decode(),
            "events_png": base64.b64encode(png_bytes(events, level=1)).decode(),
        }


def _number(query: Mapping[str, str], name: str, default: float) -> float:
    with contextlib.suppress(ValueError):
        return float(query.get(name, ""))
    return default
