"""Events → images, and files in ComfyUI's output folder."""

from __future__ import annotations

import os
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, OutputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.io.files import extension_of, writable_formats
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import PALETTES
from texvent.view.windows import cut_windows

from .event_nodes import EVENTS, RATE
from .model_nodes import CATEGORY
from .tensors import images_of


class TexventPreviewEvents:
    """Images of events, one per step of time."""

    TITLE = "Preview events"
    DESCRIPTION = "Images of events; ON and OFF have the colours of a palette."
    CATEGORY = CATEGORY
    RETURN_TYPES = ("IMAGE",)
    RETURN_NAMES = ("images",)
    FUNCTION = "draw"

    @classmethod
    def INPUT_TYPES(cls) -> dict[str, Any]:  # noqa: N802  (ComfyUI's name)
        """Events, and how they are shown."""
        window = {"default": 0.0, "min": 0.0, "max": 1e6, "step": 0.1, "round": False}
        window["tooltip"] = "Time that an image gathers, ms; 0: until the next image."
        fps = {"default": 30.0, **RATE, "tooltip": "Images per second of the recording."}
        most = {"default": 300, "min": 1, "max": 100_000, "tooltip": "No more images than this."}
        return {
            "required": {
                "events": (EVENTS,),
                "fps": ("FLOAT", fps),
                "window_ms": ("FLOAT", window),
                "palette": (list(PALETTES), {"default": next(iter(PALETTES))}),
                "max_images": ("INT", most),
            }
        }

    def draw(self, events: Any, **options: Any) -> tuple[Any]:
        """IMAGE of the events."""
        return (images_of(event_images(_checked(events), **options)),)


def event_images(
    events: EventStream, fps: float, window_ms: float, palette: str, max_images: int
) -> NDArray[np.uint8]:
    """Images of events [B, H, W, 3]; one empty image where there is no event."""
    step_us = MICROSECONDS / Fraction(str(fps))
    window_us = max(1, round(window_ms * 1000) or round(step_us))
    colours, drawn = PALETTES[palette], []
    windows = cut_windows([events], step_us=step_us, window_us=window_us)
    for window in windows:
        if len(drawn) == max_images:
            break
        drawn.append(draw_events(window.counts, colours))
    if not drawn:
        drawn.append(draw_events(np.zeros((2, *events.size.shape), dtype=np.int32), colours))
    return np.stack(drawn)


class TexventSaveEvents:
    """Events in a file of any of texvent's formats."""

    TITLE = "Save events"
    DESCRIPTION = "Writes events into ComfyUI's output folder, in any format of texvent."
    CATEGORY = CATEGORY
    RETURN_TYPES = ("STRING",)
    RETURN_NAMES = ("path",)
    FUNCTION = "save"
    OUTPUT_NODE = True

    @classmethod
    def INPUT_TYPES(cls) -> dict[str, Any]:  # noqa: N802
        """Events, where they go, and the format."""
        text = "Name in the output folder; folders before a slash; a number is added."
        prefix = {"default": "events/texvent", "tooltip": text}
        return {
            "required": {
                "events": (EVENTS,),
                "filename_prefix": ("STRING", prefix),
                "format": (writable_formats(), {"default": "hdf5"}),
            }
        }

    def save(self, events: Any, filename_prefix: str, format: str) -> dict[str, Any]:
        """Write the file; the page shows its name."""
        events = _checked(events)
        extension = extension_of(format)
        path = output_path(filename_prefix, extension)
        events.save(path, format=format)
        text = f"{path.name}: {len(events):,} events, {events.size}"
        return {"ui": {"text": [text]}, "result": (str(path),)}


def output_path(prefix: str, extension: str) -> Path:
    """A name that is free, inside ComfyUI's output folder.

    Raises:
        OutputError: the name would lie outside.
    """
    import folder_paths  # of ComfyUI

    root = Path(folder_paths.get_output_directory()).resolve()
    # pathlib resolves no name with a NUL.
    wanted = root if "\0" in prefix else (root / prefix.replace("\\", "/")).resolve()
    if not wanted.is_relative_to(root) or wanted == root:
        raise OutputError(
            f"filename_prefix is {prefix[:80]!r}, which is no name inside the output folder; give "
            "one such as events/texvent"
        )
    folder, name, number, *_ = folder_paths.get_save_image_path(prefix, str(root))
    while True:
        path = Path(folder) / f"{name}_{number:05}_{extension}"
        if not os.path.lexists(path):
            return path
        number += 1


def _checked(events: Any) -> EventStream:
    if not isinstance(events, EventStream):
        raise InputError(
            f"the events are a {type(events).__name__}; connect a node of texvent that gives events"
        )
    return events
