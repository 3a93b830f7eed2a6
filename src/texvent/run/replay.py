"""A run, or its frames, made again from the provenance stored in an event file."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from texvent._registry import GENERATORS
from texvent._version import full_version
from texvent.errors import MAX_SHOWN, InputError, shown
from texvent.generate.protocol import renders_instants
from texvent.generate.scene_input import SCENE_KEY, Subject, stored_subject
from texvent.pipeline import Simulation, fit_to_sensor, text_to_video
from texvent.run.prepare import prepare_prompt, prepare_source, prepare_video
from texvent.run.settings import Settings, flatten_tables, resolve
from texvent.scenes.assets.nouns import check_files
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


def prepare_replay(
    metadata: Mapping[str, Any], *, path: Path, source: Path | None = None
) -> Simulation:
    """The run that made a recording, ready to be made again.

    Args:
        metadata: of an event file, as a run stores it.
        path: of the event file: a source that is not where it was is looked for in its folder.
        source: the frames, where they are elsewhere; of a generated recording, the video that
            texvent stored, which is then not generated again.

    Raises:
        InputError: no run is stored, the file was edited or is only a part, or its source is gone.
        ConfigError: its options are not known here.
    """
    tables, facts, folder = metadata.get("settings"), metadata.get("source"), path.parent
    if not (isinstance(tables, Mapping) and isinstance(facts, Mapping)):
        raise InputError("the file does not say how it was made, so it cannot be made again")
    _refuse_other_recordings(metadata, path)
    options, prompt = flatten_tables(tables, folder), metadata.get("prompt")
    prompt = prompt if isinstance(prompt, str) else None
    if "generate" in tables:
        settings = resolve("generate", options)
        if source is not None:
            video = fit_to_sensor(_stored_video(source, facts), settings)
            return prepare_video(video, settings, prompt=prompt)
        subject = stored_subject(metadata if SCENE_KEY in metadata else {"prompt": prompt, **facts})
        return replace(_generate_again(subject, facts, settings), prompt=prompt)
    settings = resolve("simulate", options)
    _refuse_fields_of_memory(facts, settings)
    shaken = facts.get("camera_seed")
    return prepare_source(
        source or _find_source(facts, folder),
        settings,
        prompt=prompt,
        video_seed=shaken if isinstance(shaken, int) else None,
    )


def _refuse_other_recordings(metadata: Mapping[str, Any], path: Path) -> None:
    """Refuse files that hold something else than their run makes."""
    if "rig" in metadata:
        raise InputError(
            "the file is of one camera of a rig, which is recorded as a whole; texvent rig does it "
            'again, with the options under "rig" and "settings" of texvent info FILE'
        )
    if metadata.get("edits"):
        raise InputError(
            f"the file was {'edited' if _is_changed(metadata) else 'cut in time'} after its run "
            "(see texvent info), so its run makes another one: "
            f"{_command(metadata, path)}"
        )
    if metadata.get("complete") is False:
        raise InputError(
            "the file is a part: its run was stopped; this makes it whole: "
            f"{_command(metadata, path)}"
        )


def _generate_again(
    subject: Subject | None, facts: Mapping[str, Any], settings: Settings
) -> Simulation:
    """The run of a prompt or a scene, whose video is generated again."""
    if facts.get("stored") is not None:
        raise InputError(
            f"its video was stored, in {facts['stored']} of its data set; take it out of that tar "
            "and name it with --source"
        )
    if subject is None:
        raise InputError("the file names neither a prompt nor a scene, so it cannot be made again")
    check_files(facts.get("files"))
    seed = _video_seed(facts, settings)
    if seed == settings.run.seed:
        return prepare_prompt(subject, settings)
    of_video = replace(settings, run=replace(settings.run, seed=seed))
    return prepare_video(text_to_video(subject, of_video), settings)


def _refuse_fields_of_memory(facts: Mapping[str, Any], settings: Settings) -> None:
    """Refuse a run whose motion vectors, or depth under a camera path, were arrays."""
    if facts.get("motion") is not None and settings.source.motion is None:
        raise InputError(
            "its motion vectors came from memory, so only the program that gave them can"
        )
    if facts.get("depth") == "array":
        raise InputError("its depth came from memory, so only the program that gave it can")


def _stored_video(path: Path, facts: Mapping[str, Any]) -> FrameStream:
    from texvent.generate.videos.stored_video import reopen  # brings PyAV

    video = reopen(path)
    if video is None:
        raise InputError(f"{path} is no video that texvent generated and stored; name that one")
    place = facts.get("stored")
    return video if place is None else video.with_metadata(stored=place)


def _video_seed(facts: Any, settings: Settings) -> int:
    """Seed of the video: in data sets a video is simulated several times with a seed each."""
    seed = facts.get("seed") if isinstance(facts, Mapping) else None
    return seed if isinstance(seed, int) else settings.run.seed


def _command(metadata: Mapping[str, Any], path: Path) -> str:
    """The command line that makes the whole run again, into a new file."""
    command, key, word = "simulate", "source", "SOURCE"
    if "generate" in metadata["settings"]:
        command, key, word = "generate", "prompt", "PROMPT"
    given = metadata["source"].get(key)
    if SCENE_KEY in metadata:
        given, word = None, "SCENE.toml"
    if isinstance(given, str) and len(given) <= MAX_SHOWN:
        word = shlex.quote(given)
    name = str(path) if len(str(path)) <= MAX_SHOWN else f"FILE{path.suffix}"
    return f"texvent {command} {word} --config {shlex.quote(name)} -o whole{path.suffix}"


def _find_source(facts: Mapping[str, Any], folder: Path) -> Path:
    """The file or folder that frames came from, where it was or beside the event file."""
    given = facts.get("source")
    if not isinstance(given, str) or facts.get("kind") == "array":
        raise InputError("its frames came from memory, so only the program that gave them can")
    for path in (Path(given), folder / given, folder / Path(given).name):
        if path.exists():
            return path
    raise InputError(f"its source {given} is not here; name it with --source")


def describe_differences(stored: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """What is not as it was when a file was made, one line each: version, weights, source, options.

    Args:
        stored: metadata of the file.
        now: provenance of the same run today.
    """
    lines = []
    for name, what in COMPARED.items():
        before, today = stored.get(name), now.get(name)
        if before == today:
            continue
        if isinstance(before, Mapping) and isinstance(today, Mapping):
            ignored = (
                ("source", "size_before_fit", "motion", "camera_files") if name == "source" else ()
            )
            for key in dict.fromkeys((*before, *today)):
                if key in ignored or before.get(key) == today.get(key):
                    continue
                if key in FINGERPRINTS:
                    lines.append(FINGERPRINTS[key])
                else:
                    was, is_now = (shown(one.get(key)) for one in (before, today))
                    lines.append(f"{what}, {key}: was {was}, is {is_now}")
        else:
            lines.append(f"{what}: was {shown(before)}, is {shown(today)}")
    return lines


FINGERPRINTS = {
    "fingerprint": "its source was changed",
    "motion_fingerprint": "its motion vectors were changed",
    "camera_fingerprint": "its camera path or depth was changed",
}
"""Digest in the facts of a source → what a difference means."""
COMPARED = {
    "texvent_version": "version",
    "weights": "weights",
    "source": "source",
    "settings": "options",
    "seed": "seed",
}
"""Parts of the provenance that decide a run's bytes → what messages call them."""
