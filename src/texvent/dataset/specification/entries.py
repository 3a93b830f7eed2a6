"""Prompts, scenes and videos that sources give; the samples of a batch, each with name and seed."""

from __future__ import annotations

import glob
import itertools
import json
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.capture.image_folder import INNER_FOLDERS
from texvent.capture.recorded_frames import is_dsec, is_evreal
from texvent.dataset.specification.list_files import (
    LIST_EXTENSIONS,
    ListEntry,
    read_list,
    scene_entry,
)
from texvent.errors import ConfigError, InputError, shown, warn
from texvent.generation.subjects import scenes
from texvent.io.ros.bag_kind import is_bag
from texvent.runtime.files.file_names import IMAGE_EXTENSIONS, VIDEO_EXTENSIONS
from texvent.runtime.identity import derived_seed, digest

FOLDER_VIDEOS = VIDEO_EXTENSIONS | {".npy"}
"""Files of these names are the videos of a folder."""
PATTERNS = {
    "videos": "*.mp4",
    "recordings": "*/",
    "folders of videos": "*/*.mp4",
    "folders of images": "*/",
}
"""Kind of content of a folder → pattern of it alone."""
ID_DIGITS = 8


@dataclass(frozen=True, kw_only=True)
class Sample(ListEntry):
    """An entry as one run of a batch."""

    key: str
    """Identity of the sample, whatever stands beside it in the list: a digest of its prompt or
    video, its name and seed, and how many equal ones come before it."""
    name: str
    seed: int


def read_samples(
    sources: Sequence[str | Path], *, seed: int, of_stills: bool = False
) -> tuple[Sample, ...]:
    """The samples of lists, videos, folders and patterns.

    Every sample gets a seed derived from the batch's and its own key, so that equal prompts differ,
    and a line that is inserted changes no other sample.

    Args:
        sources: lists of prompts or videos (`.txt`, `.csv`, `.jsonl`), scene files, video files,
            folders of videos, an image folder, folders of either, patterns such as `clips/*.mp4`.
        seed: of the batch.
        of_stills: every image of a folder is a sample, not the folder.

    Raises:
        InputError: a source does not exist or holds nothing; two samples have one name.
        FileFormatError: a line of a list cannot be read.
        ConfigError: prompts and videos are mixed.
    """
    found = {str(source): list(entries_of(str(source), of_stills)) for source in sources}
    entries = [entry for source in sources for entry in found[str(source)]]
    if not entries:
        raise InputError("there is nothing to do; name a list of prompts, videos or a folder")
    if len({entry.video is None for entry in entries}) > 1:
        raise ConfigError("a batch is made of prompts or of videos; run one batch for each")
    roots = [_root(str(source)) for source in sources for _ in found[str(source)]]
    samples = tuple(_with_keys(entries, roots, seed))
    _refuse_equal_names(samples)
    return samples


def are_videos(sources: Sequence[str | Path]) -> bool:
    """True if the first source that can be read holds videos; errors come from `read_samples`."""
    for source in sources:
        try:
            for entry in entries_of(str(source)):
                return entry.video is not None
        except (ConfigError, InputError):
            continue
    return False


def entries_of(source: str, of_stills: bool = False) -> Iterator[ListEntry]:
    """Samples of a list, video, folder or pattern; arguments and errors as `read_samples`."""
    path = Path(source)
    if path.is_dir():
        yield from _folder_stills(path) if of_stills else _folder_entries(path)
    elif path.suffix.lower() in LIST_EXTENSIONS:
        yield from read_list(path)
    elif scenes().is_scene_file(source) and (path.exists() or not glob.has_magic(source)):
        yield scene_entry(source, path)
    elif path.exists():
        yield ListEntry(where=source, video=path)
    elif glob.has_magic(source):
        found = sorted(glob.glob(source, recursive=True))
        if not found:
            raise InputError(f"nothing matches {shown(source)}")
        for one in found:
            yield from entries_of(one, of_stills)
    else:
        raise InputError(
            f"no such file or folder: {source}; give a list ({', '.join(LIST_EXTENSIONS)}), "
            "videos, a folder of videos or a pattern in quotes"
        )


def _folder_entries(folder: Path) -> Iterator[ListEntry]:
    """A recording, the videos in a folder, itself if it holds images, or those of its folders.

    Folders of images are those that hold no video: a picture beside videos is none of their frames.
    """
    if _is_recording(folder):
        yield ListEntry(where=str(folder), video=folder)
        return
    inside = _visible(folder)
    inner = [path for path in _folders(inside) if path.name in INNER_FOLDERS and _has_images(path)]
    folders = [path for path in _folders(inside) if path not in inner]
    recordings = [path for path in folders if _is_recording(path)]
    videos = {path: _videos(_visible(path)) for path in folders if path not in recordings}
    kinds = {
        "videos": _videos(inside),
        "images": [folder] if inner or _holds_images(inside) else [],
        "recordings": recordings,
        "folders of videos": [video for of_one in videos.values() for video in of_one],
        "folders of images": [path for path in videos if not videos[path] and _has_images(path)],
    }
    found = [kind for kind, paths in kinds.items() if paths]
    if not found:
        raise InputError(
            f"{folder} holds no video, no images and no folders of either; videos end in "
            f"{', '.join(sorted(FOLDER_VIDEOS))}"
        )
    for path in kinds[found[0]]:
        yield ListEntry(where=str(path), video=path)
    if found[1:]:
        patterns = [f"'{folder}/{PATTERNS[kind]}'" for kind in found if kind in PATTERNS]
        warn(
            f"{folder} holds {' and '.join(found)}, of which the {found[0]} are taken alone; name "
            f"each kind by a pattern, such as {' or '.join(patterns)}"
        )


def _is_recording(folder: Path) -> bool:
    return is_evreal(folder) or is_dsec(folder) or is_bag(folder)


def _has_images(folder: Path) -> bool:
    """Whether the folder or its usual sub-folder holds images."""
    inner = (folder / name for name in INNER_FOLDERS)
    return any(_holds_images(_visible(one)) for one in _folders([folder, *inner]))


def _folder_stills(folder: Path) -> Iterator[ListEntry]:
    """Every image in a folder, or else in the folders in it."""
    inside = _visible(folder)
    if not _holds_images(inside):
        inside = [image for path in _folders(inside) for image in _visible(path)]
    images = [path for path in inside if _holds_images([path])]
    if not images:
        raise InputError(f"{folder} holds no image, and `camera` moves a camera over images")
    for path in images:
        yield ListEntry(where=str(path), video=path)


def _visible(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if not path.name.startswith("."))


def _folders(paths: Iterable[Path]) -> list[Path]:
    """The folders that may be read."""
    return [path for path in paths if os.access(path, os.R_OK | os.X_OK) and path.is_dir()]


def _videos(paths: Iterable[Path]) -> list[Path]:
    return [path for path in paths if path.suffix.lower() in FOLDER_VIDEOS]


def _holds_images(paths: Iterable[Path]) -> bool:
    return any(path.suffix.lower() in IMAGE_EXTENSIONS for path in paths)


def _root(source: str) -> Path:
    """The folder that a folder or a pattern looks into: names say which one below it a video is of.

    Of a file, itself.
    """
    parts = Path(source).parts
    plain = itertools.takewhile(lambda part: not glob.has_magic(part), parts)
    return Path(source) if Path(source).exists() else Path(*plain)


def _with_keys(entries: Iterable[ListEntry], roots: Iterable[Path], seed: int) -> Iterator[Sample]:
    seen: Counter[str] = Counter()
    for entry, root in zip(entries, roots, strict=True):
        video = moved_together(entry.video)
        what: list[object] = [entry.prompt, video, entry.name, entry.seed]
        if entry.scene is not None:
            what.append(scenes().scene_to_data(entry.scene))
        same = json.dumps([*what, entry.video and str(entry.video.absolute())])
        seen[same] += 1
        key = digest([*what, seen[same]])
        own = {
            "key": key,
            "name": entry.name or _made_name(entry, root, key),
            "seed": derived_seed(seed, key) if entry.seed is None else entry.seed,
        }
        yield Sample(**{**vars(entry), **own})


def moved_together(path: Path | None) -> str | None:
    """The last two parts of a path: a list and its videos may move together."""
    return "/".join(path.absolute().parts[-2:]) if path else None


def _made_name(entry: ListEntry, root: Path, key: str) -> str:
    """First words of a prompt, or folder below `root` and name of a video; the key's beginning."""
    subject = entry.video.stem if entry.video else (entry.prompt or "")
    words = re.findall(r"[a-z0-9]+", subject.lower())[:8]
    if entry.video is not None and root in entry.video.parent.parents:
        words = re.findall(r"[a-z0-9]+", entry.video.parent.name.lower())[:8] + words
    return "-".join([*words, key[:ID_DIGITS]])[-120:]


def _refuse_equal_names(samples: Sequence[Sample]) -> None:
    places: dict[str, tuple[str, str]] = {}
    for sample in samples:
        name = sample.name.lower()  # some file systems do not tell A from a
        where, key = places.setdefault(name, (sample.where, sample.key))
        is_made = sample.key == key and name.endswith(key[:ID_DIGITS])  # `EventFiles.settled` does
        if where != sample.where and not is_made:
            raise InputError(
                f"{sample.where} and {where} have one name, {shown(sample.name)}; give each its own"
            )
