"""Ground truth read back; optical flow as 16-bit PNG, as DSEC stores it.

Three channels, in the order of the file (RGB): `u · 128 + 2¹⁵`, `v · 128 + 2¹⁵`, 1 where the
flow is valid. Steps are 1/128 px; displacements are within ±256 px.

Source: Gehrig et al., E-RAFT: Dense Optical Flow from Event Cameras, 3DV 2021, whose ground truth
DSEC publishes.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.io.arrays.npz import read_arrays
from texvent.io.input_checks import existing_file, existing_folder
from texvent.runtime.image_files import decode_image
from texvent.sensor import SensorSize, checked_size
from texvent.truth.layout import DIRECTIONS, FACTS, FORMAT, TIMES
from texvent.truth.poses import rotation_matrix

NOT_UNIT = 1e-3
"""Most that the length of a quaternion may be off 1."""
STEPS_PER_PX = 128.0
ZERO = 2.0**15
HIGHEST = 2**16 - 1


def encode_flow(flow: NDArray[np.floating[Any]]) -> NDArray[np.uint16]:
    """Flow as DSEC's pixels.

    Args:
        flow: [H, W, 2] x and y, pixels; NaN where it is not known.

    Returns:
        [H, W, 3] RGB. Where the flow is not known, or beyond ±256 px, it is 0 and not valid.

    Example:
        >>> encode_flow(np.array([[[1.0, -0.5], [np.nan, np.nan]]])).tolist()
        [[[32896, 32704, 1], [32768, 32768, 0]]]
    """
    steps = np.rint(flow.astype(np.float64) * STEPS_PER_PX + ZERO)
    is_valid = np.logical_and(steps >= 0, steps <= HIGHEST).all(axis=2)
    pixels = np.full((*flow.shape[:2], 3), ZERO, dtype=np.uint16)
    pixels[is_valid, :2] = steps[is_valid]
    pixels[..., 2] = is_valid
    return pixels


_FACT_TYPES = {
    **dict.fromkeys(("frames", "width", "height"), int),
    **{"parts": list, "classes": dict, "instances": dict, "run": dict},
}


@dataclass(frozen=True, eq=False, repr=False)
class Truth:
    """Ground truth of a clip; images are read when they are asked for.

    Frames are numbered from 0. A part that was not written raises InputError.
    """

    folder: Path
    """Folder of the truth."""
    facts: Mapping[str, Any]
    """Content of truth.json."""
    times_us: NDArray[np.int64]
    """[N] times of the frames, µs, on the clock of the events."""

    def __repr__(self) -> str:
        return f"Truth({len(self)} frames, {self.size}, {', '.join(self.parts)})"

    def __len__(self) -> int:
        """Number of frames."""
        return len(self.times_us)

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return checked_size(int(self.facts["width"]), int(self.facts["height"]))

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the parts that were written."""
        return tuple(self.facts["parts"])

    @property
    def classes(self) -> dict[int, str]:
        """Class id → name, of the objects of the clip; 0, the background, is not among them."""
        return {int(number): name for number, name in self.facts["classes"].items()}

    @property
    def instances(self) -> dict[int, str]:
        """Instance id → class name, of the objects of the clip."""
        named = self.facts["instances"].items()
        return {int(number): one["class"] for number, one in named}

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Provenance: prompt, seed, options, version."""
        run: Mapping[str, Any] = self.facts["run"]
        return run

    def flow(self, index: int) -> NDArray[np.float32]:
        """[H, W, 2] px from frame `index` to the next; NaN where it is not known."""
        flow: NDArray[np.float32] = self._flow("flow", index)["flow"]
        return flow

    def flow_back(self, index: int) -> NDArray[np.float32]:
        """[H, W, 2] px from frame `index` to the one before; NaN where it is not known."""
        flow: NDArray[np.float32] = self._flow("flow-back", index)["flow"]
        return flow

    def occluded(self, index: int, part: str = "flow") -> NDArray[np.bool_]:
        """[H, W] whether what frame `index` shows is hidden at the next.

        Args:
            index: number of the frame.
            part: "flow-back": hidden at the frame before.

        Raises:
            InputError: the source of the frames does not tell.
        """
        arrays = self._flow(part, index)
        if "occluded" not in arrays:
            raise InputError(f"{self.folder} does not say what is occluded: its source did not")
        occluded: NDArray[np.bool_] = arrays["occluded"]
        return occluded

    def depth(self, index: int) -> NDArray[np.float32]:
        """[H, W] m along the optical axis; inf for the sky."""
        self._need("depth", index)
        depth: NDArray[np.float32] = self._array(f"depth/{index:06d}.npz", "depth")
        return depth

    def instance(self, index: int) -> NDArray[np.int32]:
        """[H, W] instance ids; 0 is the background."""
        self._need("ids", index)
        return self._image(f"instance/{index:06d}.png").astype(np.int32)

    def class_id(self, index: int) -> NDArray[np.int32]:
        """[H, W] class ids; 0 is the background."""
        self._need("ids", index)
        return self._image(f"class/{index:06d}.png").astype(np.int32)

    @cached_property
    def boxes(self) -> NDArray[Any]:
        """[n] records t (µs), x, y, w, h (px), class_id, track_id (the instance), confidence 1."""
        self._need("boxes")
        try:
            boxes: NDArray[Any] = np.load(self.folder / "boxes/bbox.npy", allow_pickle=False)
        except (OSError, ValueError) as error:
            raise self._damaged("boxes/bbox.npy", error) from error
        return boxes

    def boxes_at(self, index: int) -> NDArray[Any]:
        """The boxes of one frame."""
        self._need("boxes", index)
        boxes: NDArray[Any] = self.boxes[self.boxes["t"] == self.times_us[index]]
        return boxes

    @cached_property
    def poses(self) -> NDArray[np.float64]:
        """[N, 4, 4] camera-to-world, m; camera axes x right, y down, z forward."""
        self._need("poses")
        rows = self._table("poses.txt", 8)
        lengths = np.linalg.norm(rows[:, 4:], axis=1)
        if not (np.isfinite(rows).all() and (np.abs(lengths - 1.0) < NOT_UNIT).all()):
            raise FileFormatError(
                f"{self.folder / 'poses.txt'} holds numbers that are no poses; a line is t_s, x, "
                "y, z, then a quaternion qx qy qz qw of length 1"
            )
        poses = np.tile(np.eye(4), (len(rows), 1, 1))
        poses[:, :3, 3] = rows[:, 1:4]
        poses[:, :3, :3] = [rotation_matrix(row[4:]) for row in rows]
        return poses

    @cached_property
    def camera_matrices(self) -> NDArray[np.float64]:
        """[N, 3, 3] intrinsics, px; pixel centres have whole coordinates."""
        self._need("poses")
        rows = self._table("intrinsics.txt", 5)
        matrices = np.tile(np.eye(3), (len(rows), 1, 1))
        matrices[:, 0, 0], matrices[:, 1, 1] = rows[:, 1], rows[:, 2]
        matrices[:, 0, 2], matrices[:, 1, 2] = rows[:, 3], rows[:, 4]
        return matrices

    @cached_property
    def event_instance(self) -> NDArray[np.uint16]:
        """[n] instance of each event, in the order of the event file."""
        self._need("events")
        ids: NDArray[np.uint16] = self._array("events.npz", "instance")
        return ids

    @cached_property
    def event_class_id(self) -> NDArray[np.uint16]:
        """[n] class of each event, in the order of the event file."""
        self._need("events")
        ids: NDArray[np.uint16] = self._array("events.npz", "class_id")
        return ids

    def _flow(self, part: str, index: int) -> dict[str, Any]:
        if part not in DIRECTIONS:
            raise InputError(f"part is {shown(part)}; it must be one of {', '.join(DIRECTIONS)}")
        is_back = part == "flow-back"
        self._need(part, index, first=int(is_back), last=int(is_back) - 1)
        name = f"flow/{DIRECTIONS[part]}_npz/{index:06d}.npz"
        arrays = self._arrays(name)
        if "flow" not in arrays:
            raise FileFormatError(f"{self.folder / name} holds no array 'flow'")
        return arrays

    def _need(self, part: str, index: int | None = None, *, first: int = 0, last: int = 0) -> None:
        """Refuse a part that was not written, and a frame that there is not."""
        if part not in self.parts:
            raise InputError(
                f"{self.folder} holds no {part}: it was written with --truth "
                f"{','.join(self.parts)}; write it again with {part}"
            )
        highest = len(self) - 1 + last
        if index is not None and not first <= index <= highest:
            raise InputError(f"frame {index} has no {part}; there are those of {first}..{highest}")

    def _array(self, name: str, key: str) -> Any:
        arrays = self._arrays(name)
        if key not in arrays:
            raise FileFormatError(f"{self.folder / name} holds no array {key!r}")
        return arrays[key]

    def _arrays(self, name: str) -> dict[str, Any]:
        return read_arrays(existing_file(self.folder / name))

    def _image(self, name: str) -> NDArray[np.uint16]:
        import cv2

        pixels = decode_image(existing_file(self.folder / name), cv2.IMREAD_UNCHANGED)
        if pixels.dtype != np.uint16:
            raise FileFormatError(f"{self.folder / name} is no 16-bit PNG")
        return np.asarray(pixels if pixels.ndim == 2 else pixels[..., ::-1])

    def _table(self, name: str, columns: int) -> NDArray[np.float64]:
        try:
            return np.loadtxt(self.folder / name, dtype=np.float64).reshape(-1, columns)
        except (OSError, ValueError) as error:
            raise self._damaged(name, error) from error

    def _damaged(self, name: str, error: BaseException) -> FileFormatError:
        return FileFormatError(f"{self.folder / name} cannot be read ({one_line(error)})")


def load_truth(folder: str | Path) -> Truth:
    """Ground truth that `texvent generate --truth` or `texvent.save_truth` wrote.

    Args:
        folder: such as "out.truth".

    Raises:
        InputError: there is no such folder.
        FileFormatError: it holds no truth, or is damaged.
    """
    path = existing_folder(folder)
    if not (path / FACTS).is_file():
        raise FileFormatError(f"{path} holds no {FACTS}; give a folder that --truth wrote")
    try:
        facts = json.loads((path / FACTS).read_text(encoding="utf-8"))
        times = np.loadtxt(path / TIMES, dtype=np.int64, ndmin=1)
    except (OSError, ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)})") from error
    if not isinstance(facts, dict) or facts.get("format") != FORMAT:
        raise FileFormatError(f"{path / FACTS} is not of the format {FORMAT!r}")
    for name, kind in _FACT_TYPES.items():
        if not isinstance(facts.get(name), kind):
            raise FileFormatError(f"{path / FACTS} is damaged: {name} is {shown(facts.get(name))}")
    if len(times) != facts["frames"]:
        raise FileFormatError(
            f"{path} is damaged: {FACTS} counts {facts['frames']} frames, {TIMES} {len(times)}"
        )
    return Truth(path, facts, times)
