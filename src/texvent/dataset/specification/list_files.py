"""Lists of prompts, scene files or videos: one per line, CSV, or JSON lines."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.errors import (
    FileFormatError,
    InputError,
    is_address,
    one_line,
    shown,
    warn,
    without_password,
)
from texvent.generation.subjects import SceneValue, Subject, scenes
from texvent.options.values import option_names
from texvent.runtime.files.file_names import NOT_IN_NAMES, inside, usable_path
from texvent.runtime.files.yaml_text import check_once, keys_once

PROMPT_COLUMNS = ("prompt", "text", "caption")
"""Names under which a column or key holds the prompt; the first that is there counts."""
VIDEO_COLUMN = "video"
SCENE_COLUMN = "scene"
NAME_COLUMNS = ("name", "id")
"""Names of the column or key with the name of a sample."""
LABEL_COLUMNS = ("label", "class")
"""Names of the column or key with the class of a sample."""
NOT_READ = {
    "split",
    *(name for one in (RunConfig, CaptureConfig, InterpolateConfig) for name in option_names(one)),
} - {"seed"}
"""Names of options; a list has no columns for them, and one would change nothing."""
_COLUMNS = f"{', '.join((*PROMPT_COLUMNS, SCENE_COLUMN))} or {VIDEO_COLUMN}"
Row = tuple[int, Mapping[Any, Any]]
"""Number of a line, and its values by column."""
LIST_EXTENSIONS = (".txt", ".csv", ".jsonl")
COMMENT = "#"
MAX_NAME_BYTES = 200


@dataclass(frozen=True)
class ListEntry:
    """One prompt, scene or video of a list."""

    where: str
    """File and line, for messages."""
    prompt: str | None = None
    """Prompt, or description of the video."""
    video: Path | None = None
    """The video; None: one is generated."""
    scene: SceneValue | None = None
    """The scene to show; None: that of the prompt."""
    name: str | None = None
    """Name for its results, without extension; None lets the caller make one."""
    seed: int | None = None
    """Seed of its own; None: one is derived."""
    label: str | None = None
    """Its class, for data sets."""

    @property
    def subject(self) -> Subject:
        """Its scene, or else its prompt."""
        return self.scene or self.prompt or ""


def read_list(path: Path) -> tuple[ListEntry, ...]:
    """All entries of a list.

    Args:
        path: `.txt`, one prompt or scene file per line, empty lines and those that begin with #
            skipped; `.csv` with a column `prompt` (or `text`, `caption`), `scene` or `video`, and
            perhaps `name` (or `id`), `seed` and `label` (or `class`); `.jsonl`, on each line a
            prompt or an object with those keys. Paths of scene files and videos count from the
            folder of the list.

    Raises:
        InputError: there is no such file, or it holds no entry.
        FileFormatError: a line cannot be read; the message names it.
        ConfigError: a field of a scene file is wrong.

    Warns:
        TexventWarning: a column has the name of an option, which a list does not set.
    """
    usable_path(path)
    rows_of = {".txt": _text_rows, ".csv": _csv_rows, ".jsonl": _json_rows}.get(path.suffix.lower())
    if rows_of is None:
        raise InputError(f"{path} is no list; its name must end in {', '.join(LIST_EXTENSIONS)}")
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"cannot read the list {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is not UTF-8 text: {error.reason}") from error
    entries, unread = [], set[str]()
    for number, row in rows_of(path, text):
        entries.append(_entry(path, number, row))
        unread.update(name for name in NOT_READ.intersection(row) if row[name] not in ("", None))
    if not entries:
        raise InputError(f"{path} holds no prompt")
    if unread:
        warn(
            f"{path}: its {', '.join(sorted(unread))} is not read, for a list sets no options; "
            "give options for the whole list, and make a list for each value"
        )
    return tuple(entries)


def scene_entry(where: str, path: Path, **known: Any) -> ListEntry:
    """The entry of a scene file, named after it unless it has a name; errors as `load_scene`."""
    scene = scenes().load_scene(path)
    name = known.pop("name", None) or path.stem
    return ListEntry(where, scene.prompt or None, scene=scene, name=name, **known)


def _text_rows(path: Path, text: str) -> Iterator[Row]:
    for number, line in enumerate(io.StringIO(text, newline=None), start=1):
        if line.strip() and not line.lstrip().startswith(COMMENT):
            yield number, {"prompt": line}


def _csv_rows(path: Path, text: str) -> Iterator[Row]:
    reader = csv.DictReader(io.StringIO(text, newline=""), strict=True)
    try:
        columns = tuple(reader.fieldnames or ())
        if not set(columns) & {*PROMPT_COLUMNS, SCENE_COLUMN, VIDEO_COLUMN}:
            raise FileFormatError(
                f"{path} has no column {_COLUMNS}, separated by commas; it has: "
                f"{shown(' | '.join(columns))}"
            )
        try:
            check_once([one for one in columns if one])
        except ValueError as error:
            raise FileFormatError(f"{path}: column {error}") from error
        for row in reader:
            # A comma too many cuts a prompt.
            extra, missing = row.get(None) or (), sum(value is None for value in row.values())
            if extra or missing:
                raise FileFormatError(
                    f"{_where(path, reader.line_num)} has {len(columns) + len(extra) - missing} "
                    f"values for {len(columns)} columns; put a prompt with commas in double "
                    "quotes, and leave a column empty by two commas"
                )
            yield reader.line_num, row
    except csv.Error as error:
        raise FileFormatError(f"{path} after line {reader.line_num}: {one_line(error)}") from error


def _json_rows(path: Path, text: str) -> Iterator[Row]:
    for number, line in enumerate(io.StringIO(text, newline=None), start=1):
        if not line.strip():
            continue
        where = _where(path, number)
        try:
            row = json.loads(line, object_pairs_hook=keys_once)
        except (ValueError, RecursionError) as error:
            raise FileFormatError(f"{where} is not JSON: {one_line(error)}") from error
        if isinstance(row, str):
            row = {"prompt": row}
        if not isinstance(row, Mapping):
            raise FileFormatError(f"{where} is neither a text nor an object")
        yield number, row


def _entry(path: Path, number: int, row: Mapping[Any, Any]) -> ListEntry:
    where = _where(path, number)
    prompt = _first(row, PROMPT_COLUMNS)
    video, scene = (_path_of(where, row, column) for column in (VIDEO_COLUMN, SCENE_COLUMN))
    if prompt is not None and not (isinstance(prompt, str) and prompt.strip()):
        raise FileFormatError(f"{where}: prompt is {shown(prompt)}; it must be a text")
    if scene is not None and (prompt is not None or video is not None):
        raise FileFormatError(f"{where} has a scene and a prompt or video; leave one of them out")
    if prompt is None and scene is None and video is None:
        raise FileFormatError(f"{where} has no {_COLUMNS}")
    known: dict[str, Any] = {
        "name": _name(where, _first(row, NAME_COLUMNS)),
        "seed": _seed(where, row.get("seed")),
        "label": _label(where, row),
    }
    if (
        scene is None
        and video is None
        and prompt is not None
        and scenes().is_scene_file(prompt.strip())
    ):
        scene = prompt.strip()
    if scene is not None:
        return scene_entry(where, path.parent / scene, **known)
    return ListEntry(
        where,
        prompt.strip() if prompt else None,
        path.parent / video if video else None,
        **known,
    )


def _first(row: Mapping[Any, Any], columns: Sequence[str]) -> Any:
    """The value of the first of some columns that has one."""
    return next((row[name] for name in columns if row.get(name) not in (None, "")), None)


def _path_of(where: str, entry: Mapping[Any, Any], column: str) -> str | None:
    path = entry.get(column) or None
    if path is not None and not isinstance(path, str):
        raise FileFormatError(f"{where}: {column} is {shown(path)}; it must be a path")
    if path is not None and is_address(path):
        raise FileFormatError(
            f"{where}: {column} is the address {without_password(path)}; a list names files"
        )
    return path


def _name(where: str, value: Any) -> str | None:
    """A name for files, without folders."""
    if value is None or value == "":
        return None
    name = str(value)
    try:
        inside(Path(), name)
        is_usable = not ("/" in name or name.startswith(".") or len(name.encode()) > MAX_NAME_BYTES)
    except (FileFormatError, UnicodeEncodeError):
        is_usable = False
    if not is_usable:
        raise FileFormatError(
            f"{where}: {shown(name)} is no name for a file; use at most {MAX_NAME_BYTES} bytes, "
            f"without / {' '.join(NOT_IN_NAMES)} and no dot in front"
        )
    return name


def _seed(where: str, value: Any) -> int | None:
    if value is None or value == "":
        return None
    try:
        seed = int(value)
    except (TypeError, ValueError, OverflowError):
        seed = -1
    if isinstance(value, (bool, float)) or not 0 <= seed < 2**63:
        raise FileFormatError(
            f"{where}: seed is {shown(value)}; it must be a whole number from 0 to 2^63 - 1"
        )
    return seed


def _label(where: str, row: Mapping[Any, Any]) -> str | None:
    label = next((row[name] for name in LABEL_COLUMNS if row.get(name) not in (None, "")), None)
    if isinstance(label, (list, dict)):
        raise FileFormatError(f"{where}: label is {shown(label)}; it must be a text")
    return None if label is None else str(label).strip()


def _where(path: Path, number: int) -> str:
    return f"{path} line {number}"
