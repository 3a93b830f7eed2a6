"""Which files a scene was made of, so that it can be made again."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError
from texvent.scenes.assets.nouns import assets_of
from texvent.scenes.description import SceneDescription
from texvent.scenes.models.protocol import Noun


def describe_file(path: Path) -> dict[str, str]:
    """A file's path and SHA-256 as JSON."""
    try:
        with path.open("rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error
    return {"file": str(path), "sha256": digest}


def list_files(description: SceneDescription, nouns: Mapping[str, Noun]) -> list[dict[str, str]]:
    """The files of assets and pictures that a scene is made of, each once."""
    files = {asset.path for one in description.objects for asset in assets_of(nouns[one.noun])}
    for one in description.objects:
        if one.picture is not None and one.picture.kind == "file":
            files.add(Path(one.picture.value))
    return [describe_file(path) for path in sorted(files)]


def check_files(described: Any) -> None:
    """Refuse files that are gone or not as they were.

    Args:
        described: the list that `list_files` gave, from an event file; anything else is passed.

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
