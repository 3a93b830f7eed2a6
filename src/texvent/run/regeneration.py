"""Video of a generated recording, rendered again from the provenance in its event file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from texvent._registry import GENERATORS
from texvent._version import full_version
from texvent.errors import InputError
from texvent.generate.protocol import renders_instants
from texvent.generate.scene_input import stored_subject
from texvent.scenes.assets.nouns import check_files
from texvent.settings.resolution import Settings, resolve
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
        time), so that the video would not fit. A part in time fits.
    """
    name, tables = metadata.get("generator"), metadata.get("settings")
    if not (isinstance(name, str) and isinstance(tables, Mapping)):
        return None
    if metadata.get("texvent_version") != full_version() or _is_changed(metadata):
        return None
    if "rig" in metadata:  # seen from another place, through another lens
        return None
    if name not in GENERATORS.builtin:
        return None
    generator_class = GENERATORS.load(name)
    if not renders_instants(generator_class):
        return None
    options = {**tables.get("run", {}), **tables.get("generate", {})}
    try:
        settings = resolve("generate", options)
        facts = metadata.get("source")
        check_files(facts.get("files") if isinstance(facts, Mapping) else None)
        seed = _video_seed(facts, settings)
        generator = generator_class(settings.source, seed=seed, size=settings.size)
        subject = stored_subject(metadata)
        video = None if subject is None else generator.generate(subject)
    except InputError:
        # Any program can write metadata: a prompt that is no scene does not make events invalid.
        return None
    return video if isinstance(video, RenderableStream) else None


def _is_changed(metadata: Mapping[str, Any]) -> bool:
    """Whether events were edited after their run by more than parts in time."""
    edits = metadata.get("edits") or []
    return not isinstance(edits, list) or any(
        not isinstance(edit, Mapping) or set(edit) != {"time"} for edit in edits
    )


def _video_seed(facts: Any, settings: Settings) -> int:
    """Seed of the video: in data sets a video is simulated several times with a seed each."""
    seed = facts.get("seed") if isinstance(facts, Mapping) else None
    return seed if isinstance(seed, int) else settings.run.seed
