"""Page of `texvent live`: a camera beside its events."""

from __future__ import annotations

import base64
import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent._registry import SIMULATORS
from texvent.errors import InputError
from texvent.io.files import extension_of, writable_formats
from texvent.represent.event_frame import event_frame
from texvent.view.drawing.canvas import Image, jpeg_bytes, png_bytes, shrink
from texvent.view.drawing.event_image import draw_events, frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.web.live import LiveEvents, Shown
from texvent.web.server import Answer, LocalServer, html_answer, page_text

WAIT_S = 1.0
"""How long a request waits for the next frame."""
GRACE_S, SILENCE_S = 2.0, 60.0
"""After a page that was closed, and one that fell silent, the server is over."""
PICTURE_WIDTH = 960
"""Widest picture of the camera, pixels."""


class LiveServer(LocalServer):
    """The page of a live source; a page asks for the next frame when it has drawn the last one.

    Args:
        live: the events, not begun; they end with the server.
        name: of the source.
        port: TCP port; 0: any free one.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, live: LiveEvents, name: str, *, port: int = 0) -> None:
        self._live = live
        self._asked_s: float | None = None
        self._left_s: float | None = None
        formats = {one: extension_of(one) for one in writable_formats()}
        self._html = page_text(
            "live.html",
            {"source": name, "simulators": SIMULATORS.names(), "formats": formats},
        )
        super().__init__(port=port)

    @property
    def is_over(self) -> bool:
        """Whether the page was closed and not opened again."""
        now, asked, left = time.monotonic(), self._asked_s, self._left_s
        if asked is None:
            return False
        is_left = left is not None and left >= asked and now - left > GRACE_S
        return is_left or now - asked > SILENCE_S

    def get(self, path: str, query: Mapping[str, str]) -> Answer | None:
        """The page; or the state, with pictures if a frame has come that is not drawn yet."""
        if path == "/":
            return html_answer(self._html)
        if path != "/next":
            return None
        self._asked_s = time.monotonic()
        text = query.get("drawn", "")
        drawn = int(text) if text.isascii() and text.isdigit() and len(text) < 18 else 0
        self._live.note_drawn(drawn)
        shown = self._live.wait(drawn, WAIT_S)
        pictures = {} if shown is None else _pictures(shown)
        return Answer(json.dumps({**self._live.describe(), **pictures}))

    def post(self, path: str, values: Mapping[str, Any]) -> bool:
        """Change, record, stop, or note that the page was closed."""
        if path == "/change":
            threshold = values.get("threshold")
            if not isinstance(threshold, int | float | None):
                raise InputError("the threshold must be a number")
            self._live.change(str(values.get("simulator")), threshold)
        elif path == "/record":
            format = values.get("format")
            self._live.record(Path(str(values.get("file", ""))), format and str(format))
        elif path == "/stop":
            self._live.stop_recording()
        elif path == "/leave":
            self._left_s = time.monotonic()
        else:
            return False
        return True

    def close(self) -> None:
        """Complete the recording and stop the server."""
        self._live.close()
        super().close()


def _pictures(shown: Shown) -> dict[str, Any]:
    palette = get_palette(DEFAULT_PALETTE)
    camera: Image = shrink(frame_image(shown.frame), PICTURE_WIDTH)
    events = draw_events(event_frame(shown.events, "count"), palette)
    return {
        "number": shown.number,
        "t_s": shown.frame.t_us / 1e6,
        "events": len(shown.events),
        "camera_picture": _data_url("jpeg", jpeg_bytes(camera, quality=85)),
        "events_picture": _data_url("png", png_bytes(events, level=1)),
    }


def _data_url(kind: str, data: bytes) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
