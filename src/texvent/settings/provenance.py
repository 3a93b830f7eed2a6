"""Provenance of a recording: stored in every output, enough to make it again."""

from __future__ import annotations

import contextlib
import functools
import glob
import hashlib
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent._version import full_version
from texvent.generation.subjects import SCENE_KEY, Subject, scenes
from texvent.prompt_report import REPORT_KEY
from texvent.runtime.files.file_names import IMAGE_EXTENSIONS
from texvent.settings.resolution import Settings

END_BYTES = 8 * 2**20
"""Bytes that are read of the beginning and of the end of a larger file."""


def describe_run(
    settings: Settings, *, prompt: str | None, source: Mapping[str, Any]
) -> dict[str, Any]:
    """Prompt or scene, report, source, models, seed, options, version and weight files of a run."""
    run = settings.run
    facts = describe_source(source)
    made_of = {key: facts.pop(key) for key in (SCENE_KEY, REPORT_KEY) if key in facts}
    return {
        "prompt": prompt,
        **made_of,
        "source": facts,
        "generator": settings.generator,
        "simulator": run.simulator,
        "preset": run.preset,
        "seed": run.seed,
        "settings": settings.as_tables(),
        "texvent_version": full_version(),
        **describe_weights(settings),
    }


def describe_weights(settings: Settings) -> dict[str, Any]:
    """Files that the models of a run read, such as network weights, under "weights".

    Nothing where they read none.

    Raises:
        InputError: such a file is missing.
    """
    interpolator = INTERPOLATORS.load(settings.interpolate.interpolate)
    simulator = SIMULATORS.load(settings.run.simulator)
    parts = {
        "interpolator": (interpolator, settings.interpolate),
        "simulator": (simulator, settings.simulate),
    }
    files = {
        role: facts
        for role, (part, config) in parts.items()
        if hasattr(part, "provenance") and (facts := part.provenance(config))
    }
    return {"weights": files} if files else {}


def describe_source(metadata: Mapping[str, Any]) -> dict[str, Any]:
    """Metadata of a video with a fingerprint of its file or folder, under "fingerprint".

    Args:
        metadata: of a video; `source` names what it was read from, `motion` the files of its
            motion vectors, which get theirs under "motion_fingerprint".
    """
    found = {"fingerprint": fingerprint(metadata.get("source"))}
    files = metadata.get("motion")
    if isinstance(files, Mapping):
        prints = [one for one in map(fingerprint, files.values()) if one is not None]
        found["motion_fingerprint"] = "-".join(prints) or None
    return {**metadata, **{name: text for name, text in found.items() if text is not None}}


def fingerprint(source: Any) -> str | None:
    """A digest of a file, or of the names and sizes in a folder or of a pattern; else None.

    Of a file, the size and the first and last `END_BYTES` count.
    """
    if not isinstance(source, str):
        return None
    try:
        path = Path(source)
        files = sorted(map(Path, glob.glob(source))) if glob.has_magic(source) else []
        if path.is_dir() or files:
            inside = files or path.iterdir()
            listing = sorted((one.name, one.stat().st_size) for one in inside)
            return hashlib.sha256(repr(listing).encode()).hexdigest()
        if not path.is_file():
            return None
        status = path.stat()
        return _file_fingerprint(str(path.absolute()), status.st_size, status.st_mtime_ns)
    except (OSError, ValueError):
        return None


@functools.lru_cache(maxsize=64)
def _file_fingerprint(path: str, size: int, changed_ns: int) -> str:
    """As `fingerprint`; read once for each state of a file."""
    del changed_ns
    digest = hashlib.sha256(str(size).encode())
    with open(path, "rb") as file:
        digest.update(file.read(END_BYTES))
        if size > END_BYTES:
            file.seek(max(END_BYTES, size - END_BYTES))
            digest.update(file.read(END_BYTES))
    return digest.hexdigest()


def files_read(settings: Settings, subject: Subject = "") -> list[str]:
    """Files and folders that options and a scene name, which the events depend on."""
    configs = settings.groups().values()
    values = (getattr(config, one.name) for config in configs for one in fields(config))
    named = [str(value) for value in values if isinstance(value, Path)]
    return [*named, *([] if isinstance(subject, str) else scenes().files_of(subject))]


def describe_state(source: str | Path) -> dict[str, str] | None:
    """Facts of a file or folder that tell later whether it was replaced; None: it cannot be read.

    `seen` is known at once, from names, sizes and times of change; `contents` is read.
    """
    try:
        listing = _listing(Path(source))
        contents = [(name, _file_fingerprint(*one)) for name, *one in listing]
    except OSError:
        return None
    return {"seen": _digest(listing), "contents": _digest(contents)}


def is_unchanged(source: str | Path, state: Any) -> bool:
    """Whether a file or folder is there and holds what it held when `describe_state` saw it."""
    if not isinstance(state, Mapping):
        return False
    with contextlib.suppress(OSError):
        if state.get("seen") == _digest(_listing(Path(source))):
            return True
    now = describe_state(source)
    return now is not None and now["contents"] == state.get("contents")


def is_replaced(source: str | Path, state: Any) -> bool:
    """Whether a file or folder holds something else than when `describe_state` described it.

    One that is gone, cannot be read, or was not described, was not replaced.
    """
    if not isinstance(state, Mapping) or is_unchanged(source, state):
        return False
    return describe_state(source) is not None


def _listing(path: Path) -> list[tuple[str, str, int, int]]:
    """Name, absolute path, size and time of change of a file, or of those in a folder.

    Of a folder of frames only these count: results may lie below them.
    """
    files = {path.name: path}
    if path.is_dir():
        inside = [one for one in sorted(path.iterdir()) if one.is_file()]
        if not any(one.suffix.lower() in IMAGE_EXTENSIONS for one in inside):
            inside = [one for one in sorted(path.rglob("*")) if one.is_file()]
        files = {one.relative_to(path).as_posix(): one for one in inside}
    found = [(name, one.absolute(), one.stat()) for name, one in files.items()]
    return [(name, str(one), status.st_size, status.st_mtime_ns) for name, one, status in found]


def _digest(values: list[Any]) -> str:
    return hashlib.sha256(repr(values).encode()).hexdigest()
