"""Ground truth of a clip in a folder, as `--truth` writes it, read back."""

from __future__ import annotations

import io
import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, one_line, shown
from texvent.io.arrays.npz import open_arrays
from texvent.io.input_checks import existing_file, existing_folder
from texvent.runtime.files.image_files import decode_image
from texvent.truth.boxes import COCO, PROPHESEE
from texvent.truth.clip import FACT_DAMAGE, ClipTruth
from texvent.truth.layout import DIRECTIONS, FACTS, FORMAT, TIMES
from texvent.truth.poses import rotation_matrix

NOT_UNIT = 1e-3
"""Most that the length of a quaternion may be off 1."""


_FACT_TYPES = {
    **dict.fromkeys(("frames", "width", "height"), int),
    **{"parts": list, "classes": dict, "instances": dict, "run": dict},
}


class FolderTruth(ClipTruth):
    """Ground truth of a clip in a folder; arrays of frames are in a file each."""

    @property
    def folder(self) -> Path:
        """Folder of the truth."""
        return Path(self.where)

    def _remedy(self, part: str) -> str:
        return f"write it again with {part} in --truth"

    def _read_facts(self) -> dict[str, Any]:
        facts = json.loads(self.read_file(FACTS))
        if not isinstance(facts, dict) or facts.get("format") != FORMAT:
            raise FileFormatError(f"{self.folder / FACTS} is not of the format {FORMAT!r}")
        for name, kind in _FACT_TYPES.items():
            value = facts.get(name)
            self._refuse(not isinstance(value, kind), f"{name} of {FACTS} is {shown(value)}")
        times = np.loadtxt(io.BytesIO(self.read_file(TIMES)), np.int64, ndmin=1)
        counted = f"{FACTS} counts {facts['frames']} frames, {TIMES} {len(times)}"
        self._refuse(len(times) != facts["frames"], counted)
        names = {number: one["class"] for number, one in facts["instances"].items()}
        ids = {number: one["object"] for number, one in facts["instances"].items()
               if "object" in one}  # fmt: skip
        return {**facts, "instances": names, "objects": ids, "times_us": times.tolist()}

    def _stored(self, part: str, name: str, numbers: range, index: int | None) -> NDArray[Any]:
        if index is None:
            return np.stack([self._stored(part, name, numbers, one) for one in numbers])
        if part == "ids":
            image = self._image(f"{name.removesuffix('_id')}/{index:06d}.png")
        else:
            place = f"flow/{DIRECTIONS[part]}_npz" if part in DIRECTIONS else part
            image = self._load(f"{place}/{index:06d}.npz", name)
        what = f"{name} of frame {index} has the shape {image.shape}, in frames of {self.size}"
        self._refuse(image.shape[:2] != self.size.shape, what)
        return image

    def _table(self, part: str, name: str) -> NDArray[Any]:
        if name == "boxes":
            return self._load(f"boxes/{PROPHESEE}")
        if name == "visibility":
            return self._visibility()
        if name == "pose":
            return self._poses()
        if name == "intrinsics":
            return self._rows("intrinsics.txt", 5)[:, 1:]
        return self._load(f"{part}.npz", name)

    def _open(self, file: str) -> Any:
        # An archive of a user may claim to unpack to anything.
        is_archive = file.endswith(".npz")
        return open_arrays(existing_file(self.folder / file)) if is_archive else super()._open(file)

    def _image(self, name: str) -> NDArray[np.uint16]:
        import cv2

        pixels = decode_image(existing_file(self.folder / name), cv2.IMREAD_UNCHANGED)
        if pixels.dtype != np.uint16:
            raise FileFormatError(f"{self.folder / name} is no 16-bit PNG")
        return pixels

    def _visibility(self) -> NDArray[np.float32]:
        try:
            boxes = json.loads(self.read_file(f"boxes/{COCO}"))["annotations"]
            return np.array([box.get("visibility", np.nan) for box in boxes], np.float32)
        except FACT_DAMAGE as error:
            what = f"{self.folder / 'boxes' / COCO} holds no boxes ({one_line(error)})"
            raise FileFormatError(what) from error

    def _poses(self) -> NDArray[np.float64]:
        rows = self._rows("poses.txt", 8)
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

    def _rows(self, name: str, columns: int) -> NDArray[np.float64]:
        try:
            text = io.BytesIO(self.read_file(name))
            return np.loadtxt(text, dtype=np.float64).reshape(-1, columns)
        except ValueError as error:
            what = f"{self.folder / name} cannot be read ({one_line(error)})"
            raise FileFormatError(what) from error


def load_truth(folder: str | Path) -> ClipTruth:
    """Ground truth that `texvent generate --truth` or `texvent.save_truth` wrote.

    Args:
        folder: such as "out.truth".

    Raises:
        InputError: there is no such folder.
        FileFormatError: it holds no truth, or is damaged.

    Example:
        >>> import texvent
        >>> frames = texvent.video("a red ball bounces", sensor="48x36", duration=0.1)
        >>> truth = texvent.load_truth(texvent.save_truth(frames, "ball.truth", "flow,depth"))
        >>> truth, truth.flow(0).shape, truth.depth(0).dtype
        (ClipTruth(3 frames, flow, depth), (36, 48, 2), dtype('float32'))
    """
    path = existing_folder(folder)
    if not (path / FACTS).is_file():
        raise FileFormatError(f"{path} holds no {FACTS}; give a folder that --truth wrote")
    truth = FolderTruth(partial(_content, path), str(path))
    truth.facts  # noqa: B018
    return truth


def _content(folder: Path, name: str) -> bytes:
    return existing_file(folder / name).read_bytes()
