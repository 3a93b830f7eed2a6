"""Training of evlib's RVT on clips with boxes: its input, its loss, and average precision.

Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with event
cameras", CVPR 2023; Z. Ge et al., "YOLOX: exceeding YOLO series in 2021", whose head and loss it
has. Network, head and loss are evlib's.
Deviations: memory starts empty in every clip; no zoom; the head computes in float32 always; pixels
may be binned.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError
from texvent.extending import require
from texvent.networks import STATE, Tensor
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.detection.clips import (
    WINDOW_US,
    BoxedClip,
    dense,
    read_classes,
    read_clips,
)
from texvent_lab.bench.detection.config import EXTRA, DetectionConfig
from texvent_lab.bench.detection.labels import COUNTED
from texvent_lab.bench.detection.precision import ALL, average_precision
from texvent_lab.networks.layers import make_seeded
from texvent_lab.train.loop import VALIDATION_SAMPLES
from texvent_lab.train.task import Batches

CLASSES, BINNING = "classes", "binning"
"""Entries of the weights file: names of the classes, and pixels along a side of a cell."""
STRIDE = 32
"""Stride of the last stage, cells; one window of attention is as large as that stage."""
LEAST_CONFIDENCE, MOST_OVERLAP = 0.01, 0.45
"""Limits of detections; more overlap with a surer one of the same class removes one."""
CLIP_US = 10_000_000
"""Distance of clips on the common clock of their boxes, µs."""
NUMBER, FLIP, FIRST, LEARNED = "number", "flip", "first", "learned"


def identity_of(clips: Sequence[BoxedClip]) -> str:
    """Number of clips, and a digest of their names and contents."""
    found = hashlib.sha256()
    for one in clips:
        found.update(one.key.encode())
        parts: list[NDArray[Any]] = [one.places, one.counts, *one.boxes]
        for part in parts:
            found.update(part.tobytes())
    return f"{len(clips)} ({found.hexdigest()[:12]})"


@dataclass(frozen=True)
class DrawnClips:
    """Training clips by number; see `MakeSample`."""

    clips: Sequence[BoxedClip]
    length: int
    windows: int
    flips: bool

    @property
    def identity(self) -> str:
        """See `MakeSample`."""
        return identity_of(self.clips)

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """A clip, whether it is mirrored, its first window, and those learned, from there on."""
        place = number % len(self.clips)
        learnable = np.array(self.clips[place].learnable)
        last = chance.choice(learnable)
        first = max(last + 1 - self.length, 0)
        seen = learnable[(learnable >= first) & (learnable <= last)]
        learned = chance.choice(seen, self.windows) - first
        flip = self.flips and bool(chance.random() < 0.5)
        return {NUMBER: place, FLIP: np.bool_(flip), FIRST: np.int64(first), LEARNED: learned}


def open_task(config: DetectionConfig) -> DetectionTask:
    """The task of a training file; see `TrainingConfig.make_task`."""
    folder, data = Path(config.data.folder or ""), config.data
    classes = read_classes(folder)
    return DetectionTask(config, classes, read_clips(folder, data.validation_split, data.binning))


class DetectionTask:
    """Boxes of road users from events."""

    score: ClassVar[str] = "AP50"

    def __init__(
        self, config: DetectionConfig, classes: tuple[str, ...], clips: list[BoxedClip]
    ) -> None:
        """A task of clips that are scored, and learned until `batches` reads those for that."""
        self._config, self.classes = config, classes
        self._validation = self._clips = clips

    @property
    def identity(self) -> str:
        """See `TrainingTask`."""
        return identity_of(self._validation)

    def make_network(self) -> Any:
        """See `TrainingTask`."""
        size = self._validation[0].shape[-2:]
        return make_detector(len(self.classes), size, self._config.seed)

    def batches(self, *, workers: int) -> Batches:
        """See `TrainingTask`."""
        data, schedule = self._config.data, self._config.schedule
        found = read_clips(Path(data.folder or ""), data.split, data.binning)
        self._clips = [one for one in found if one.learnable]
        sizes = {one.shape[1:] for one in (*self._clips, *self._validation)}
        if not self._clips or len(sizes) > 1:
            raise InputError(
                f"{data.folder} has clips of {len(sizes)} sizes, {len(self._clips)} of them with "
                "moving boxes; export clips of one sensor, with boxes of the detector's classes"
            )
        make = DrawnClips(self._clips, data.length, data.windows, self._config.flip_x)
        count = len(self._clips) * data.passes
        return Batches(make, count, schedule.batch_size, self._config.seed, workers=0)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """YOLOX's loss in the windows that are learned, with the memory of all before them."""
        torch = require("torch", extra=EXTRA)
        length, starts = self._config.data.length, batch[FIRST].tolist()
        clips = [
            self._clips[number].part(first, length)
            for number, first in zip(batch[NUMBER].tolist(), starts, strict=True)
        ]
        flips, learned = batch[FLIP], batch[LEARNED].tolist()
        histograms = dense(clips, device)
        histograms[flips.to(device)] = histograms[flips.to(device)].flip(-1)
        last = max(map(max, learned))
        chosen: list[dict[int, Tensor]] = []
        boxes: list[NDArray[np.float32]] = []
        for window, features in enumerate(run_backbone(network, histograms[:, : last + 1])):
            rows = [n for n, windows in enumerate(learned) for one in windows if one == window]
            if rows:
                chosen.append({stage: one[rows] for stage, one in features.items()})
                boxes += [targets(clips[n], window, bool(flips[n])) for n in rows]
        joined = {stage: torch.cat([one[stage] for one in chosen]) for stage in chosen[0]}
        return run_head(network, joined, _padded(boxes).to(device))[1]["loss"]

    def validate(
        self, network: Any, device: Any, *, workers: int
    ) -> tuple[dict[str, float], dict[str, list[Any]]]:
        """AP at an overlap of .5 and over all, in windows with boxes, and how many these are.

        Returns:
            Columns of the predictions, a value per detection: `sample`, `t_us` in it, `class`, `x`
            and `y` of the left upper corner, `w`, `h`, pixels of the sensor, and `confidence`.
        """
        del workers
        found = detect_clips(network, self._validation, device)
        truth = join_boxes([one.boxes for one in self._validation])
        counted = truth["class_confidence"] == COUNTED
        return {
            "AP50": average_precision(found, truth, classes=self.classes, iou=(0.5,))[ALL],
            "AP": average_precision(found, truth, classes=self.classes)[ALL],
            VALIDATION_SAMPLES: len(self._validation),
            f"boxes of {VALIDATION_SAMPLES}": int(counted.sum()),
        }, self._columns(found)

    def _columns(self, found: NDArray[np.void]) -> dict[str, list[Any]]:
        numbers, times_us = np.divmod(found["t"], CLIP_US)
        pixels = self._config.data.binning
        return {
            "sample": [self._validation[one].key for one in numbers.tolist()],
            "t_us": times_us.tolist(),
            "class": [self.classes[one] for one in found["class_id"].tolist()],
            **{side: (found[side].astype(float) * pixels).round(1).tolist() for side in "xywh"},
            "confidence": found["class_confidence"].astype(float).round(4).tolist(),
        }

    def published(self, network: Any) -> Mapping[str, Any]:
        """Evlib's names."""
        tensors = {name: one.detach().cpu() for name, one in network.state_dict().items()}
        return {STATE: tensors, CLASSES: list(self.classes), BINNING: self._config.data.binning}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `TrainingTask`."""
        found, binning = tuple(content.get(CLASSES, ())), self._config.data.binning
        if (found, content.get(BINNING)) != (self.classes, binning):
            raise FileFormatError(
                f"{path} has no weights for binning {binning} and the classes "
                f"{', '.join(self.classes)}; texvent train detection writes them as weights.pt"
            )
        try:
            network.load_state_dict(content[STATE])
        except (RuntimeError, KeyError, TypeError) as error:
            raise FileFormatError(f"{path} holds other tensors than evlib's RVT-T has") from error


def make_detector(classes: int, size: tuple[int, int], seed: int) -> Any:
    """Evlib's RVT-T with random weights.

    Args:
        classes: number of them.
        size: height and width of the histograms, cells, which choose the windows of attention.
        seed: of the weights.
    """
    models = require("evlib.models.rvt", extra=EXTRA)
    part = tuple(-(-side // STRIDE) for side in size)
    return make_seeded(
        lambda: models.RVT(variant="tiny", num_classes=classes, partition_size=part), seed
    )


def run_backbone(network: Any, histograms: Tensor) -> Iterator[dict[int, Tensor]]:
    """Features of successive windows; memory is empty before the first.

    Args:
        network: evlib's RVT.
        histograms: [clips, windows, channels, height, width]; enlarged to the right and below to
            what the windows of attention divide.
    """
    pad = require("torch", extra=EXTRA).nn.functional.pad
    parts = network.backbone.config.partition_size
    below, right = (
        -side % (STRIDE * part) for side, part in zip(histograms.shape[-2:], parts, strict=True)
    )
    states = None
    for window in range(histograms.shape[1]):
        image = pad(histograms[:, window].float(), (0, right, 0, below))
        features, states = network.forward_backbone(image, states)
        yield features


def run_head(
    network: Any, features: Mapping[int, Tensor], targets: Tensor | None = None
) -> tuple[Tensor, Any]:
    """Evlib's predictions, and its losses where there are targets, in float32.

    The head keeps the grid of cells that it meets first; sizes and modes of autograd differ here.
    """
    torch = require("torch", extra=EXTRA)
    network.head.output_grids = network.head.output_strides = None
    inputs = {stage: one.float() for stage, one in features.items()}
    with torch.autocast(inputs[2].device.type, enabled=False):
        found: tuple[Tensor, Any] = network.forward_detect(inputs, targets)
    return found


def targets(clip: BoxedClip, window: int, flip: bool) -> NDArray[np.float32]:
    """Boxes of a window that count, [n, 5]: class, x and y of the middle, width, height."""
    boxes = clip.boxes[window]
    boxes = boxes[boxes["class_confidence"] == COUNTED]
    x = boxes["x"] + boxes["w"] / 2
    if flip:
        x = clip.shape[-1] - x
    y = boxes["y"] + boxes["h"] / 2
    return np.stack([boxes["class_id"], x, y, boxes["w"], boxes["h"]], axis=1).astype(np.float32)


def _padded(boxes: Sequence[NDArray[np.float32]]) -> Tensor:
    rows = np.zeros((len(boxes), max(map(len, boxes)), 5), np.float32)
    for row, one in zip(rows, boxes, strict=True):
        row[: len(one)] = one
    return require("torch", extra=EXTRA).from_numpy(rows)


def detect_clips(
    network: Any, clips: Sequence[BoxedClip], device: Any, *, batch: int = 8
) -> NDArray[np.void]:
    """Detections in all windows with boxes, `BOX_RECORD` on the clock of `join_boxes`."""
    found = []
    for first in range(0, len(clips), batch):
        chosen = clips[first : first + batch]
        for window, predictions in enumerate(_predict(network, dense(chosen, device))):
            for place, one in enumerate(predictions):
                clip = chosen[place]
                if window < len(clip.boxes) and len(clip.boxes[window]):
                    t_us = (first + place) * CLIP_US + (window + 1) * WINDOW_US
                    found.append(as_boxes(one, t_us, clip.shape[-2:]))
    return np.concatenate(found) if found else np.zeros(0, BOX_RECORD)


def join_boxes(clips: Sequence[Sequence[NDArray[np.void]]]) -> NDArray[np.void]:
    """Boxes of clips on one clock: window k of clip n ends at n · `CLIP_US` + (k + 1) · 50 ms."""
    joined = []
    for number, windows in enumerate(clips):
        for window, boxes in enumerate(windows):
            moved = boxes.copy()
            moved["t"] = number * CLIP_US + (window + 1) * WINDOW_US
            joined.append(moved)
    return np.concatenate(joined)


def detect_last(network: Any, histograms: Sequence[NDArray[np.uint8]], device: Any) -> Tensor:
    """Detections [n, 7] of evlib at the end of the last of successive windows; None for none."""
    torch = require("torch", extra=EXTRA)
    windows = torch.from_numpy(np.stack(histograms))[None].to(device)
    return list(_predict(network, windows))[-1][0]


def _predict(network: Any, histograms: Tensor) -> Iterator[list[Tensor | None]]:
    """Evlib's detections of each clip, window by window."""
    torch = require("torch", extra=EXTRA)
    postprocess = require("evlib.models.yolox_head", extra=EXTRA).postprocess
    with torch.inference_mode():
        for features in run_backbone(network, histograms):
            found, _ = run_head(network, features)
            yield postprocess(found, network.num_classes, LEAST_CONFIDENCE, MOST_OVERLAP)


def as_boxes(found: Tensor | None, t_us: int, size: Sequence[int]) -> NDArray[np.void]:
    """Detections of evlib as `BOX_RECORD`, cut at the edges of the histograms.

    Args:
        found: [n, 7] left, top, right, bottom, objectness, class confidence, class; None for none.
        t_us: their time.
        size: height and width of the histograms, cells.
    """
    if found is None:
        return np.zeros(0, BOX_RECORD)
    rows = found.float().cpu().numpy()
    boxes = np.zeros(len(rows), BOX_RECORD)
    left, right = rows[:, 0].clip(0, size[1] - 1), rows[:, 2].clip(0, size[1] - 1)
    top, bottom = rows[:, 1].clip(0, size[0] - 1), rows[:, 3].clip(0, size[0] - 1)
    boxes["t"], boxes["x"], boxes["y"] = t_us, left, top
    boxes["w"], boxes["h"] = right - left, bottom - top
    boxes["class_confidence"] = rows[:, 4] * rows[:, 5]
    boxes["class_id"] = rows[:, 6]
    return boxes[(boxes["w"] > 0) & (boxes["h"] > 0)]
