"""The frames behind an event file, made again from the provenance stored in it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from texvent._registry import GENERATORS
from texvent._version import __version__
from texvent.errors import InputError
from texvent.run.settings import resolve
from texvent.video import FrameStream, RenderableStream


def render_again(metadata: Mapping[str, Any]) -> FrameStream | None:
    """The video that a generated recording was simulated from, rendered again.

    Only generators that render any instant can do it; they also know its ground truth. The
    same version of texvent is needed, so that the scene is the same to the last pixel.

    Args:
        metadata: of an event file, as a run stores it.

    Returns:
        The video, not rendered before it is iterated; None where the recording was not made by
        such a generator, was made by another version, or was edited since (cropped, moved in
        time), so that the video would not fit.
    """
    name, prompt, tables = (metadata.get(key) for key in ("generator", "prompt", "settings"))
    if not (isinstance(name, str) and isinstance(prompt, str) and isinstance(tables, Mapping)):
        return None
    if metadata.get("texvent_version") != __version__ or metadata.get("edits"):
        return None
    if name not in GENERATORS.builtin:
        return None
    generator_class = GENERATORS.load(name)
    if generator_class.default_interpolate != "exact":
        return None
    options = {**tables.get("run", {}), **tables.get("generate", {})}
    try:
        settings = resolve("generate", options)
        generator = generator_class(settings.source, seed=settings.run.seed, size=settings.size)
        video = generator.generate(prompt)
    except InputError:
        # Any program can write metadata: a prompt that is no scene does not make events invalid.
        return None
    return video if isinstance(video, RenderableStream) else None
