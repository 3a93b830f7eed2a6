"""Files that a scene names: pictures and models, described and checked."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError
from texvent.generation.subjects import Subject
from texvent_scenes.spec.scene import Scene


def describe_file(path: Path) -> dict[str, str]:
    """A file's path and SHA-256 as JSON."""
    try:
        with path.open("rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error
    return {"file": str(path), "sha256": digest}


def files_of(subject: Subject, assets: Path | None = None) -> list[str]:
    """Pictures and models that a scene names, and the folder of its models; nothing is read."""
    objects = subject.objects if isinstance(subject, Scene) else ()
    pictures = [
        one.picture.value
        for one in objects
        if one.picture is not None and one.picture.kind == "file"
    ]
    models = [one.model for one in objects if one.model is not None]
    return [*map(str, (*pictures, *models)), *([] if assets is None else [str(assets)])]


def check_files(described: Any) -> None:
    """Refuse files that are gone or not as they were.

    Args:
        described: the list of `assets.nouns.list_files`, from an event file; anything else is
            passed.

    Raises:
        InputError: a file is gone.
        FileFormatError: a file was changed.
    """
    for one in described if isinstance(described, list) else ():
        if not isinstance(one, Mapping) or not isinstance(one.get("file"), str):
            continue
        path = Path(one["file"])
        if not path.is_file():
            raise InputError(f"{path}, which the events were made with, is not here")
        if describe_file(path)["sha256"] != one.get("sha256"):
            raise FileFormatError(f"{path} was changed since the events were made with it")
