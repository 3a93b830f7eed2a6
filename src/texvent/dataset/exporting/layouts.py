"""Where the samples of a data set lie in the layouts of others, and what these cannot hold."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent._registry import suggest
from texvent.errors import ConfigError, InputError, shown

Files = Mapping[str, str]
"""Path in the exported folder → content."""
EVALUATION = ("val", "valid", "validation", "test", "testing")
"""Names of splits that N-ImageNet and DSEC know under one name only."""


@dataclass(frozen=True)
class Exported:
    """A sample that was written."""

    path: Path
    """In the exported folder."""
    split: str
    label: str | None


@dataclass(frozen=True, kw_only=True)
class Layout:
    """One way to lay out a data set."""

    format: str
    """Name of the codec of event files."""
    place: Callable[[str, str | None, str], Path]
    """Split, class and key of a sample → its path in the exported folder."""
    lists: Callable[[Path, list[Exported]], Files] = lambda folder, exported: {}
    """Exported folder and what is in it → further files."""
    needs_classes: bool = False
    has_two_splits: bool = False
    """Whether all splits of `EVALUATION` become one."""
    size: tuple[int, int] | None = None
    """Width and height that its readers take for granted, pixels."""
    lost: str = ""
    """What it cannot hold."""


def folder_name(label: str) -> str:
    """A class as the name of a folder.

    Raises:
        InputError: nothing of it can be one.

    Example:
        >>> folder_name("fire truck/red")
        'fire_truck_red'
    """
    name = re.sub(r"[^\w.-]+", "_", label).strip("._")
    if not name:
        raise InputError(f"class {shown(label)} cannot name a folder; give it another name")
    return name


def find_layout(name: str) -> Layout:
    """The layout of that name.

    Raises:
        ConfigError: there is none.
    """
    if name not in LAYOUTS:
        raise ConfigError(f"unknown format {shown(name)}; {suggest(name, tuple(LAYOUTS))}")
    return LAYOUTS[name]


def _train_or(name: str, split: str) -> str:
    """The two splits of others; further ones keep their names."""
    if split == "train":
        return "train"
    return name if split in EVALUATION else split


def _n_imagenet(split: str, label: str | None, key: str) -> Path:
    folder = f"extracted_{_train_or('val', split)}"
    return Path(folder) / folder_name(label or "") / f"{key}.npz"


def _n_imagenet_lists(folder: Path, exported: list[Exported]) -> Files:
    """Absolute paths, as its own lists have them: its loader opens them from anywhere."""
    lines: dict[str, list[str]] = {"train": [], "val": []}
    for one in exported:
        lines.setdefault(_train_or("val", one.split), []).append(str(folder / one.path))
    return {f"{name}_list.txt": "".join(f"{line}\n" for line in lines[name]) for name in lines}


def _n_caltech101(split: str, label: str | None, key: str) -> Path:
    return Path("Caltech101") / folder_name(label or "") / f"{key}.bin"


def _split_lists(folder: Path, exported: list[Exported]) -> Files:
    """The layout has no splits, so lists beside it say them."""
    lines: dict[str, list[str]] = {}
    for one in exported:
        lines.setdefault(one.split, []).append(str(one.path))
    return {f"{split}.txt": "".join(f"{line}\n" for line in lines[split]) for split in lines}


LAYOUTS: Mapping[str, Layout] = {
    "hdf5": Layout(format="hdf5", place=lambda split, label, key: Path(split) / f"{key}.h5"),
    "n-imagenet": Layout(
        format="n-imagenet",
        place=_n_imagenet,
        has_two_splits=True,
        lists=_n_imagenet_lists,
        needs_classes=True,
        size=(640, 480),
        lost="captions (its readers have classes alone)",
    ),
    "dsec": Layout(
        format="dsec",
        has_two_splits=True,
        place=lambda split, label, key: (
            Path(_train_or("test", split)) / key / "events" / "left" / "events.h5"
        ),
        size=(640, 480),
        lost="captions and classes; there is one camera, and no images, disparity or flow",
    ),
    "n-caltech101": Layout(
        format="atis",
        place=_n_caltech101,
        lists=_split_lists,
        needs_classes=True,
        lost="captions, splits (lists beside it say them), sensors over 256x240, times from "
        "8.39 s on",
    ),
}
