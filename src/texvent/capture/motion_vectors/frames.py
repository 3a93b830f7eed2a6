"""Frames with the motion vectors, depth and ids of their renderer, and their check."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.frame_source import ChangedFrames
from texvent.capture.image_folder import INNER_FOLDERS
from texvent.capture.intensity_scale import scale_to_levels
from texvent.capture.motion_vectors.check import Neighbours, Verdict, judge
from texvent.capture.motion_vectors.conventions import (
    CONVENTIONS,
    Convention,
    Direction,
    changes,
    check_vectors,
    instance_ids,
    metric_depth,
    named_convention,
    parse_convention,
    to_pixels,
    wrong_size,
)
from texvent.capture.motion_vectors.fields import (
    ROLE_KIND,
    FieldStack,
    Role,
    open_fields,
    written_by,
)
from texvent.config import CaptureConfig
from texvent.errors import InputError, warn
from texvent.frames import Frame, FrameStream, MotionVectors
from texvent.pairs.instants import matching_luma

CHECKED_FRAMES = 4
"""Frames whose vectors are compared with the images around them."""
SPARSE = 4
"""Every so many rows and columns tell how much a frame moves."""
FRAMES_LOOKED_AT = 12
"""Frames read for that: those at the start may stand still."""


@dataclass(frozen=True)
class _Field:
    """One kind of vectors: in which stack, under which name, and where they lead."""

    role: Role
    kind: str
    direction: Direction


class MotionFrames(ChangedFrames):
    """The frames of a stream with motion, read beside them one by one.

    There is one field per frame, or, of vectors, one per pair of frames: then the backward ones
    begin with the second frame. What only one direction is given of stays None in the other.

    Raises:
        InputError: another number of fields than of frames.
    """

    def __init__(
        self, stream: FrameStream, stacks: Mapping[Role, FieldStack], config: CaptureConfig
    ) -> None:
        super().__init__(stream)
        self._stacks, self._config = stacks, config
        self._convention, self._text = _convention(stacks, config)
        self._vectors = _vector_fields(stacks, self._convention)
        self._is_counted = stream.metadata.get("kind") != "video file"
        for role, stack in stacks.items():
            self._check_count(stack, role)

    @property
    def metadata(self) -> Mapping[str, Any]:
        """The source's, the files of motion and their convention."""
        return {
            **self.source.metadata,
            "motion": {role: stack.name for role, stack in self._stacks.items()},
            "motion_convention": self._text,
        }

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order.

        Raises:
            InputError: a field of another size, of wrong values, or missing.
        """
        previous: Frame | None = None
        for index, (frame, following) in enumerate(_with_next(self.source)):
            yield replace(frame, motion=self._motion(index, previous, frame, following))
            previous = frame

    def check(self) -> None:
        """Compare warped frames with real ones near the start.

        Raises:
            InputError: another convention fits clearly better.

        Warns:
            TexventWarning: the vectors hardly explain what changes.
        """
        frames = list(islice(self.source, FRAMES_LOOKED_AT))
        for field in self._vectors:
            verdict = judge(self._neighbours(frames, field), self._convention, field.direction)
            if verdict is not None:
                self._report(verdict, field)

    def _report(self, verdict: Verdict, field: _Field) -> None:
        what = f"{self._stacks[field.role].name}: {field.direction} motion vectors"
        if verdict.better is not None:
            given = replace(self._convention, direction=field.direction)
            words = changes(given, verdict.better, field.direction)
            advice = f"as motion_convention={self._with(words)}; give that"
            is_named = field.kind != "vectors" or len(self._vectors) > 1
            if is_named and verdict.better.direction != field.direction:
                words = tuple(word for word in words if word not in ("forward", "backward"))
                advice = f"{verdict.better.direction}; exchange the two"
                if words:
                    advice += f" and give motion_convention={self._with(words)}"
            raise InputError(
                f"{what} do not fit the frames: warped by them, frames differ by "
                f"{verdict.error:.1f} grey levels, and by {verdict.better_error:.1f} if the "
                f"vectors are meant {advice}, or check_motion=False if they are right"
            )
        if verdict.is_high:
            warn(
                f"{what} explain little: warped by them, frames differ by {verdict.error:.1f} grey "
                f"levels, and by {verdict.still_error:.1f} as they are; check that the vectors "
                "belong to these frames"
            )

    def _with(self, words: Sequence[str]) -> str:
        """The convention with more words, which change the earlier ones."""
        return ",".join([one for one in (self._text, *words) if one])

    def _neighbours(self, frames: Sequence[Frame], field: _Field) -> list[Neighbours]:
        """The frames near the start that move most, with what is stored for them."""
        levels = [self._levels(frame) for frame in frames]
        found: list[tuple[float, Neighbours]] = []
        for index in range(len(frames)):
            luma = {"here": levels[index]}
            stored: dict[Direction, NDArray[Any]] = {}
            places: tuple[tuple[Direction, int], ...] = (
                ("forward", index + 1),
                ("backward", index - 1),
            )
            for direction, place in places:
                at = self._place(field, direction, index)
                if 0 <= place < len(frames) and at is not None:
                    luma[direction] = levels[place]
                    stored[direction] = self._stacks[field.role].field(field.kind, at)
            if stored:
                values = next(iter(stored.values()))
                self._check_field(values, field, index)
                some = values[::SPARSE, ::SPARSE, :2] - self._convention.offset
                size = float(np.nan_to_num(np.abs(some)).mean())
                found.append((size, Neighbours(luma, stored)))
        found.sort(key=lambda one: -one[0])
        return [one for _, one in found[:CHECKED_FRAMES]]

    def _levels(self, frame: Frame) -> NDArray[np.float32]:
        white = self._config.white_level
        luma = matching_luma(frame) if white is None else scale_to_levels(frame.luma, white)
        return np.asarray(luma, dtype=np.float32)

    def _motion(
        self, index: int, previous: Frame | None, frame: Frame, following: Frame | None
    ) -> MotionVectors:
        others = {"forward": following, "backward": previous}
        vectors: dict[str, NDArray[np.float32]] = {}
        for field in self._vectors:
            other = others[field.direction]
            at = self._place(field, field.direction, index)
            if other is None:
                continue
            if at is None:
                raise InputError(self._missing(field.role, index))
            stored = self._stacks[field.role].field(field.kind, at)
            self._check_field(stored, field, index)
            vectors[field.direction] = to_pixels(
                stored, self._convention, field.direction, frame.size
            )
        return MotionVectors(
            vectors.get("forward"),
            vectors.get("backward"),
            self._depth(index, frame),
            self._instance(index, frame),
        )

    def _check_field(self, stored: NDArray[Any], field: _Field, index: int) -> None:
        where = f"{self._stacks[field.role].name}, frame {index}: the {field.direction} field"
        check_vectors(stored, where)
        width, height = self.source.size
        factor = width // stored.shape[1]
        if factor < 1 or (stored.shape[1] * factor, stored.shape[0] * factor) != (width, height):
            raise InputError(wrong_size(where, stored.shape, self.source.size))

    def _depth(self, index: int, frame: Frame) -> NDArray[np.float32] | None:
        stored, where = self._plane("depth", index)
        if stored is None:
            return None
        return metric_depth(stored, self._config.depth_scale, frame.size, where)

    def _instance(self, index: int, frame: Frame) -> NDArray[np.int32] | None:
        stored, where = self._plane("instances", index)
        return None if stored is None else instance_ids(stored, frame.size, where)

    def _plane(self, kind: str, index: int) -> tuple[NDArray[Any] | None, str]:
        """Depth or ids of a frame: from their own option, or from the files of the vectors."""
        for role in (kind, "motion"):
            stack = self._stacks.get(role)
            if stack is not None and kind in stack.found and index < stack.count:
                return stack.field(kind, index), f"{stack.name}, frame {index}: {kind}"
        return None, ""

    def _place(self, field: _Field, direction: Direction, index: int) -> int | None:
        """Index of the field of a frame in its stack; None if it has none."""
        count, frames = self._stacks[field.role].count, self.source.frame_count
        is_per_pair = frames is not None and count == frames - 1
        place = index - (direction == "backward" and is_per_pair)
        return place if 0 <= place < count else None

    def _check_count(self, stack: FieldStack, role: Role) -> None:
        frames = self.source.frame_count
        has_vectors = role in ("motion", "motion_back")
        if frames is None or not self._is_counted:
            return
        if stack.count == frames - 1 and stack.gap is not None:
            raise InputError(
                f"{stack.name} lacks a file between {stack.gap}, so which frame has which vectors "
                "is not clear; render it again"
            )
        if stack.count != frames and not (has_vectors and stack.count == frames - 1):
            pairs = f", or {frames - 1}: one per pair" if has_vectors else ""
            raise InputError(
                f"{stack.name} has fields of {stack.count} frames, and there are {frames} frames; "
                f"give {frames}: one per frame{pairs}"
            )

    def _missing(self, role: Role, index: int) -> str:
        stack = self._stacks[role]
        return (
            f"{stack.name} has fields of {stack.count} frames, but there is a frame {index}; give "
            "one per frame, or one per pair"
        )


def _convention(stacks: Mapping[Role, FieldStack], config: CaptureConfig) -> tuple[Convention, str]:
    """Meaning of the vectors, and the same as the option says it."""
    said = next((stack.convention for stack in stacks.values() if stack.convention), None)
    text = config.motion_convention
    if text is None:
        text = said or ""
    elif said is not None and named_convention(text) is None:
        text = f"{said},{text}"
    return (parse_convention(text) if text else CONVENTIONS["standard"]), text


def _vector_fields(stacks: Mapping[Role, FieldStack], convention: Convention) -> tuple[_Field, ...]:
    """The fields of vectors; each direction once.

    Raises:
        InputError: a direction is given twice.
    """
    fields: dict[Direction, _Field] = {}
    for role in ("motion", "motion_back"):
        stack = stacks.get(role)
        if stack is None:
            continue
        for kind in sorted(stack.found & {"vectors", "forward", "backward"}):
            named: Direction = "forward" if kind == "forward" else "backward"
            direction = convention.direction if kind == "vectors" else named
            if direction in fields:
                raise InputError(
                    f"{direction} vectors are given twice, by {fields[direction].role} "
                    f"({fields[direction].kind}) and {role} ({kind}); leave one out"
                )
            fields[direction] = _Field(role, kind, direction)
    return tuple(fields.values())


def _with_next(frames: FrameStream) -> Iterator[tuple[Frame, Frame | None]]:
    """Each frame with the one after it."""
    current: Frame | None = None
    for frame in frames:
        if current is not None:
            yield current, frame
        current = frame
    if current is not None:
        yield current, None


OWN_FOLDER = "motion"
"""Folder of passes beside the folder of frames, as the script for Blender makes it."""


def attach_motion(
    stream: FrameStream, config: CaptureConfig, given: Mapping[str, Any] | None
) -> FrameStream:
    """The stream with the fields of files and of memory in `Frame.motion`.

    Args:
        stream: frames as they come, not cut or fitted yet.
        config: its options motion, motion_back, depth, instances, motion_convention, depth_scale
            and check_motion.
        given: the same by name, as arrays or paths; they replace those of `config`.

    Returns:
        `stream` itself where nothing is named.

    Raises:
        InputError: there is no such file, its size or number does not fit the frames, the stream
            is live, or another convention fits the frames clearly better.
        FileFormatError: a file is damaged.
        ConfigError: the convention is unknown.
    """
    sources = {role: getattr(config, role) for role in ROLE_KIND}
    sources.update({role: one for role, one in (given or {}).items() if one is not None})
    sources = {role: one for role, one in sources.items() if one is not None}
    if not sources:
        for name in ("motion_convention", "depth_scale"):
            if getattr(config, name) is not None:
                warn(f"{name} has no effect: motion is not given")
        return stream
    if stream.is_live:
        raise InputError("motion vectors need frames that can be read twice, not a live stream")
    stacks = {role: open_fields(one, role) for role, one in sources.items()}
    motion = MotionFrames(stream, stacks, config)
    if config.check_motion:
        motion.check()
    return motion


def find_motion_sidecar(source: Any) -> Path | None:
    """Motion passes beside or inside a folder of frames, or None.

    They are OpenEXR files in a folder `motion` beside its folder of images, or its own OpenEXR
    files: their channels have names, so nothing is guessed.
    """
    if not isinstance(source, str | Path):
        return None
    try:
        folder = Path(source).expanduser()
        if not folder.is_dir():
            return None
        has_images = any((folder / name).is_dir() for name in INNER_FOLDERS)
        if has_images and any((folder / OWN_FOLDER).glob("*.exr")):
            return folder / OWN_FOLDER
        images = sorted(folder.glob("*.exr"))
    except (OSError, ValueError, RuntimeError):  # no path, or the home of an unknown user
        return None
    if not images:
        return None
    return folder if written_by(images[0]) else None
