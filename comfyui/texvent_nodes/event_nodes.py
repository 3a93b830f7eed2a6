"""Images, videos and prompts → events."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import texvent
from texvent.config import InterpolateConfig, RunConfig
from texvent.errors import InputError, TexventError
from texvent.prompt_report import PromptReport
from texvent.sensor import parse_sensor

from .model_nodes import CATEGORY, MODEL
from .progress import comfy_progress
from .tensors import frames_of
from .widgets import widgets

EVENTS = "TEXVENT_EVENTS"
INTERPOLATE = ["flow", "blend", "none", "rife"]
RATE = {"min": 0.001, "max": 1e6, "step": 0.01, "round": False}


def _common_inputs() -> dict[str, Any]:
    run = widgets(RunConfig(), ("sensor", "seed", "device"))
    seed_type, seed = run["seed"]
    return {**run, "seed": (seed_type, {**seed, "min": 0, "control_after_generate": True})}


def _frame_inputs() -> dict[str, Any]:
    config = InterpolateConfig()
    found = widgets(config, ("interpolate", "max_intermediate", "deflicker"))
    return {**found, "interpolate": (INTERPOLATE, found["interpolate"][1])}


class _EventNode:
    """What the nodes share."""

    CATEGORY = CATEGORY
    RETURN_TYPES: tuple[str, ...] = (EVENTS,)
    RETURN_NAMES: tuple[str, ...] = ("events",)
    FUNCTION = "simulate"

    @classmethod
    def _optional(cls) -> dict[str, Any]:
        return {"model": (MODEL, {"tooltip": "Pixel model; without it, texvent's own."})}

    @classmethod
    def VALIDATE_INPUTS(cls, sensor: str | None = None) -> bool | str:  # noqa: N802
        """True, or what is wrong with the sensor."""
        try:
            if sensor:
                parse_sensor(sensor)
        except TexventError as error:
            return str(error)
        return True


class TexventImagesToEvents(_EventNode):
    """Events of a batch of images, as the frames of a video."""

    TITLE = "Images to events"
    DESCRIPTION = "Events that an event camera would record of these images, shown at a frame rate."

    @classmethod
    def INPUT_TYPES(cls) -> dict[str, Any]:  # noqa: N802  (ComfyUI's name)
        """Images, their rate, and options."""
        fps = {"default": 24.0, **RATE, "tooltip": "Images per second."}
        required = {"images": ("IMAGE",), "fps": ("FLOAT", fps)}
        return {
            "required": {**required, **_common_inputs(), **_frame_inputs()},
            "optional": cls._optional(),
        }

    def simulate(self, images: Any, fps: float, model: Any = None, **options: Any) -> tuple[Any]:
        """The events."""
        return (_simulate(images, Fraction(str(fps)), model, options),)


class TexventVideoToEvents(_EventNode):
    """Events of a VIDEO, at its own frame rate."""

    TITLE = "Video to events"
    DESCRIPTION = "Events that an event camera would record of this video."

    @classmethod
    def INPUT_TYPES(cls) -> dict[str, Any]:  # noqa: N802
        """A video and options."""
        return {
            "required": {"video": ("VIDEO",), **_common_inputs(), **_frame_inputs()},
            "optional": cls._optional(),
        }

    def simulate(self, video: Any, model: Any = None, **options: Any) -> tuple[Any]:
        """The events."""
        if not hasattr(video, "get_components"):
            raise InputError(f"the video is a {type(video).__name__}; connect that of Load Video")
        parts = video.get_components()
        return (_simulate(parts.images, Fraction(parts.frame_rate), model, options),)


class TexventPromptToEvents(_EventNode):
    """Events of a scene that texvent draws itself, without weights."""

    TITLE = "Prompt to events"
    DESCRIPTION = "Events of the scene that a sentence describes, by texvent's embedded generator."
    RETURN_TYPES = (EVENTS, "STRING")
    RETURN_NAMES = ("events", "report")

    @classmethod
    def INPUT_TYPES(cls) -> dict[str, Any]:  # noqa: N802
        """A sentence and options."""
        text = {"default": "a red car drives left", "multiline": True, "tooltip": "What to show."}
        seconds = {"default": 1.0, "min": 0.01, "max": 600.0, "step": 0.1, "round": False}
        fps = {"default": 30.0, **RATE, "tooltip": "Source frames per second."}
        required = {"prompt": ("STRING", text), "duration": ("FLOAT", seconds)}
        return {
            "required": {**required, "fps": ("FLOAT", fps), **_common_inputs()},
            "optional": cls._optional(),
        }

    def simulate(
        self, prompt: str, duration: float, fps: float, model: Any = None, **options: Any
    ) -> tuple[Any, str]:
        """The events, and what the generator shows of the sentence."""
        options = {**_given(options), **(model or {}), "fps": Fraction(str(fps))}
        events = texvent.generate(prompt, duration=duration, progress=comfy_progress(), **options)
        report = PromptReport.of_metadata(events.metadata)
        lines = [] if report is None else [*report.scene, *report.notes]
        return events, "\n".join(lines)


def _simulate(images: Any, fps: Fraction, model: Any, options: dict[str, Any]) -> Any:
    frames = frames_of(images)
    options = {**_given(options), **(model or {}), "fps": fps}
    # Float frames are on texvent's scale of 0..255; white_level says so of dark ones too.
    return texvent.simulate(frames, white_level=255.0, progress=comfy_progress(), **options)


def _given(options: dict[str, Any]) -> dict[str, Any]:
    """The options without empty texts, which stand for "not given"."""
    return {name: value for name, value in options.items() if value not in ("", None)}
