"""The parts of ground truth that can be written, by name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from texvent._registry import GENERATORS, suggest
from texvent.errors import ConfigError, shown
from texvent.io.atomic import check_output_folder

PARTS: Mapping[str, str] = MappingProxyType(
    {
        "flow": "optical flow to the next frame, and what gets hidden",
        "flow-back": "optical flow to the frame before, and what was hidden there",
        "depth": "depth in metres",
        "ids": "instance and class of each pixel",
        "boxes": "2-D boxes: COCO JSON, and Prophesee's .npy",
        "poses": "camera intrinsics and poses",
        "events": "instance and class of each event",
    }
)
"""Name → what it is."""
CLIP_FILES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "boxes": ("boxes.npy", "visibility.npy"),
        "flow": ("flow.npz",),
        "depth": ("depth.npz",),
        "ids": ("ids.npz",),
        "poses": ("poses.npz",),
    }
)
"""Part of the truth of a sample → its files. Archives hold `t`, the times of their rows, µs."""
ALL = "all"


def parse_parts(wanted: str | Iterable[str] | None) -> tuple[str, ...]:
    """Names of parts, in the order of `PARTS`.

    Args:
        wanted: "flow,depth", several names, "all"; None or an empty text: none.

    Raises:
        ConfigError: an unknown name.

    Example:
        >>> parse_parts("depth, flow"), parse_parts("")
        (('flow', 'depth'), ())
    """
    words = [wanted] if isinstance(wanted, str) else list(wanted or ())
    if not all(isinstance(word, str) for word in words):
        raise ConfigError(f"truth is {shown(wanted)}; give names such as 'flow,depth', or 'all'")
    names = [name for word in words for name in word.replace(" ", "").split(",") if name]
    for name in names:
        if name not in PARTS and name != ALL:
            raise ConfigError(f"no part {shown(name)} of truth; {suggest(name, (*PARTS, ALL))}")
    return tuple(name for name in PARTS if name in names or ALL in names)


def check_generator(name: str) -> None:
    """Refuse truth of videos that a generator makes without knowing their scene.

    Raises:
        ConfigError: it does not know it.
    """
    if not getattr(GENERATORS.load(name), "has_ground_truth", False):
        raise ConfigError(
            f"truth is asked for, but generator {shown(name)} does not know the scene of its "
            "videos; leave it out, or take generator procedural"
        )


FACTS, TIMES = "truth.json", "timestamps.txt"
FORMAT = "texvent truth 1"
DIRECTIONS = {"flow": "forward", "flow-back": "backward"}
"""Part → how its files are named."""
_OWN = re.compile(
    r"truth\.json|timestamps\.txt|flow/(for|back)ward(_npz)?/\d+\.(png|npz)|"
    r"flow/(for|back)ward_timestamps\.txt|"
    r"depth/\d+\.npz|(instance|class)/\d+\.png|boxes/(coco\.json|bbox\.npy)|camera\.json|"
    r"poses\.txt|intrinsics\.txt|events\.npz|overlay\.mp4"
)


def check_truth_folder(path: Path, *, overwrite: bool) -> None:
    """Refuse a place that truth cannot be put at, before any work.

    Raises:
        OutputError: it exists already, holds other files, or cannot be written.
    """
    check_output_folder(path, overwrite=overwrite, is_own=is_own_file(path), is_nested=True)


def is_own_file(folder: Path) -> Callable[[Path], bool]:
    """Tells whether a file in the folder, or in the one that becomes it, is one of truth."""

    def is_own(path: Path) -> bool:
        return bool(_OWN.fullmatch(path.relative_to(folder.resolve()).as_posix()))

    return is_own


def truth_folder(events: Path) -> Path:
    """Folder of the truth of an event file.

    Example:
        >>> truth_folder(Path("runs/out.h5")).as_posix()
        'runs/out.truth'
    """
    return events.with_name(f"{events.with_suffix('').name}.truth")
