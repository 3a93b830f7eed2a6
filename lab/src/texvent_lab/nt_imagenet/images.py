"""The images of ImageNet that N-ImageNet's streams were recorded from, and the names of classes."""

from __future__ import annotations

from collections.abc import Mapping
from io import StringIO
from pathlib import Path

from texvent.errors import FileFormatError, InputError, shown

FOLDERS = ("", "val", "ILSVRC2012_img_val", "Data/CLS-LOC/val", "ILSVRC/Data/CLS-LOC/val")
"""Where copies of ImageNet keep the validation images, all in one folder or by class."""
EXTENSIONS = (".JPEG", ".jpeg", ".jpg", ".png")
NAME_FILES = ("LOC_synset_mapping.txt", "synset_words.txt")


def find_image(folder: Path, wnid: str, id: str) -> Path | None:
    """The image of a stream, or None."""
    for inside in FOLDERS:
        for place in (folder / inside / wnid, folder / inside):
            for extension in EXTENSIONS:
                path = place / f"{id}{extension}"
                if path.is_file():
                    return path
    return None


def find_class_names(
    folder: Path | None, file: Path | None = None
) -> Mapping[str, tuple[str, ...]]:
    """WordNet id → its names; empty where there is no list of them.

    Args:
        folder: ImageNet's, which may hold `LOC_synset_mapping.txt` or `synset_words.txt`.
        file: such a list elsewhere: on each line an id, then names with commas between.

    Raises:
        InputError: the file cannot be read.
        FileFormatError: a line is not of this form.
    """
    if file is None:
        found = (
            [folder / name for name in NAME_FILES if (folder / name).is_file()] if folder else []
        )
        if not found:
            return {}
        file = found[0]
    try:
        lines = StringIO(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {file}: {error}") from error
    names: dict[str, tuple[str, ...]] = {}
    for number, line in enumerate(lines, start=1):
        wnid, _, rest = line.strip().partition(" ")
        synonyms = tuple(name.strip() for name in rest.split(",") if name.strip())
        if not wnid:
            continue
        if not synonyms:
            raise FileFormatError(
                f"{file} line {number} is {shown(line.strip())}; it must be an id and names, such "
                "as n01440764 tench, Tinca tinca"
            )
        names[wnid] = synonyms
    return names
