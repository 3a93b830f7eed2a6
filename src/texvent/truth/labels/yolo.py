"""YOLO folder: a .txt for each frame, with lines `class cx cy w h` in shares of the picture.

The number at the end of a name is that of the frame, from 0 where one is 0, else from 1. A file
without lines says that the frame shows nothing; a frame without a file is not labelled. Names of
the classes are in classes.txt, one per line, or in data.yaml, in the folder or one of two above.

Source: the label format of Darknet and Ultralytics.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import yaml

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.truth.labels.labels import Labels, make_labels

NAMES, DATA = "classes.txt", "data.yaml"
FEWEST = 5
"""Words of a line; a confidence or a track may follow and is not read."""


def read_yolo(path: Path) -> Labels:
    """Labels of a YOLO folder.

    Raises:
        FileFormatError: a file is no label file.
        InputError: no box, no names of classes, or a class without a name.
    """
    files = {}
    for one in sorted(path.glob("*.txt")):
        number = re.search(r"(\d{1,15})$", one.stem)
        if number is not None:
            files[int(number[1])] = one
    first = min(1, *files) if files else 0
    names = _names(path)
    rows = [
        (number - first, *row) for number, one in files.items() for row in _rows(one, len(names))
    ]
    frames = {number - first for number in files}
    return make_labels(path, rows, names, frames=frames, is_relative=True)


def _rows(path: Path, classes: int) -> Iterator[tuple[float, ...]]:
    try:
        lines = path.read_text(encoding="ascii").splitlines()
        table = [list(map(float, line.split())) for line in lines if line.strip()]
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path} cannot be read as YOLO text ({one_line(error)})") from error
    for values in table:
        if len(values) < FEWEST:
            raise FileFormatError(f"{path} has a line of {len(values)} numbers; class cx cy w h")
        kind, cx, cy, w, h = values[:FEWEST]
        if kind not in range(classes):
            raise InputError(f"{path} has class {kind:g}, and {classes} classes have names, from 0")
        yield cx - w / 2, cy - h / 2, w, h, int(kind), 0, 1.0


def _names(path: Path) -> tuple[str, ...]:
    folder = path.absolute()
    for place in (folder, *folder.parents[:2]):
        try:
            if (place / NAMES).is_file():
                lines = (place / NAMES).read_text(encoding="utf-8").splitlines()
                return tuple(line.strip() for line in lines if line.strip())
            if (place / DATA).is_file():
                names = yaml.safe_load((place / DATA).read_text(encoding="utf-8"))["names"]
                listed = [names[one] for one in sorted(names)] if isinstance(names, dict) else names
                return tuple(map(str, listed))
        except (OSError, ValueError, TypeError, KeyError, yaml.YAMLError) as error:
            raise FileFormatError(
                f"{place} names no classes that can be read ({one_line(error)})"
            ) from error
    raise InputError(
        f"{shown(str(path))} has numbers for classes; put their names into {NAMES} beside it, one "
        "per line from 0"
    )
