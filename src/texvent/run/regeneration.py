"""Video of a generated recording, rendered again from the provenance in its event file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from texvent._registry import GENERATORS
from texvent._version import full_version
from texvent.errors import InputError, shown, warn
from texvent.frames import FrameStream, RenderableStream
from texvent.generation.protocol import renders_instants
from texvent.generation.subjects import scenes, stored_subject
from texvent.settings.resolution import Settings, resolve


def render_again(metadata: Mapping[str, Any], *, with_files: bool = False) -> FrameStream | None:
    """The video that a generated recording was simulated from, rendered again.

    Only generators that render any instant can do it; they also know its ground truth. The
    same version of texvent is needed, so that the scene is the same to the last pixel.

    Args:
        metadata: of an event file, as a run stores it.
        with_files: whether a scene may show pictures and models that the metadata name, with their
            digests: the sender of the file chose them, and the result shows them.

    Returns:
        The video, not rendered before it is iterated; None where the recording was not made by
        such a generator, was made by another version, or was edited since (cropped, moved in
        time), so that the video would not fit. A part in time fits.

    Warns:
        TexventWarning: the scene shows files, and is not rendered.
    """
    name, tables = metadata.get("generator"), metadata.get("settings")
    if not (isinstance(name, str) and isinstance(tables, Mapping)):
        return None
    if metadata.get("texvent_version") != full_version() or _is_changed(metadata):
        return None
    if "rig" in metadata:  # seen from another place, through another lens
        return None
    if name not in GENERATORS.shipped():
        return None
    generator_class = GENERATORS.load(name)
    if not renders_instants(generator_class):
        return None
    try:
        settings, facts = _settings(tables), metadata.get("source")
        subject = stored_subject(metadata)
        if subject is None:
            return None
        files = scenes().files_of(subject, getattr(settings.source, "assets", None))
        if files and not with_files:
            warn(
                f"the scene is not drawn beside the events: it shows {shown(files[0])} of this "
                "machine, as the event file says; --video files draws it if they are as they were"
            )
            return None
        listed = facts.get("files") if isinstance(facts, Mapping) else None
        scenes().check_files(listed)
        generator = generator_class(
            settings.source, seed=_video_seed(facts, settings), size=settings.size
        )
        video = generator.generate(subject)
    except (InputError, TypeError, ValueError):
        # Any program can write metadata: a prompt that is no scene does not make events invalid.
        return None
    if video.metadata.get("files", []) != (listed or []):
        return None  # a file that is not listed, with its digest
    return video if isinstance(video, RenderableStream) else None


def _settings(tables: Mapping[str, Any]) -> Settings:
    """Settings of the video that a file states; options that read files of their own are left."""
    run = {name: one for name, one in tables.get("run", {}).items() if name in ("seed", "sensor")}
    if "." in str(run.get("sensor")):
        del run["sensor"]
    return resolve("generate", {**run, **tables.get("generate", {})})


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
