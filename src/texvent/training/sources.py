"""Sources of training clips: videos, folders of images, prompts, data sets, and your own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.api import functions as api
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.dataset.generation.recipe import SPECIFICATION_FILE, load_recipe
from texvent.dataset.layouts.frames import clip_frames
from texvent.dataset.specification.entries import entries_of
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import ConfigError, InputError, few, shown
from texvent.frames import FrameStream, transfer_of
from texvent.generation.subjects import Subject
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.training.codec import decode_video
from texvent.transfer import Transfer
from texvent.truth.boxes import BOX_RECORD, box_records
from texvent.truth.class_ids import class_ids_of

TRUTH = ("flow", "depth", "boxes")
"""Truth that a clip can bring."""
Truth: TypeAlias = Callable[[NDArray[np.int64], str], NDArray[Any]]
"""Gives one part of the truth at the times of frames, µs."""
BYTES_PER_PIXEL = {"flow": 8, "depth": 4, "boxes": 0}
"""Memory of the truth of a frame."""
WHITE = 255.0
CODING_GAMMA = 2.2


@dataclass(frozen=True, eq=False)
class Clip:
    """A video in memory, with its truth.

    Raises:
        InputError: frames of another kind or shape, or times that do not rise.

    Example:
        >>> import numpy as np
        >>> from texvent.training import Clip
        >>> Clip(np.zeros((3, 24, 32), np.uint8), np.array([0, 40_000, 80_000])).nbytes
        2328
    """

    frames: NDArray[np.uint8]
    """[N, H, W] luma."""
    times_us: NDArray[np.int64]
    """[N] strictly increasing, µs."""
    truth: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """`flow`: px from each frame to the next, x right and y down, [N − 1, 2, H, W] float32;
    `depth`: m, [N, H, W] float32; `boxes`: records of `texvent.truth.boxes.BOX_RECORD`, by time."""

    def __post_init__(self) -> None:
        shape, times_us = self.frames.shape, self.times_us
        if self.frames.dtype != np.uint8 or len(shape) != 3 or not all(shape):
            raise InputError(
                f"frames of a clip are {self.frames.dtype} {list(shape)}; they must be uint8 luma, "
                "[frames, rows, columns]"
            )
        if times_us.shape != shape[:1] or (np.diff(times_us) <= 0).any():
            raise InputError("times of a clip must rise, one per frame")

    @property
    def nbytes(self) -> int:
        """Memory."""
        arrays: tuple[NDArray[Any], ...] = (self.frames, self.times_us, *self.truth.values())
        return sum(one.nbytes for one in arrays)


@runtime_checkable
class ClipSource(Protocol):
    """Videos by number, always the same.

    Example:
        >>> import numpy as np
        >>> from texvent.training import Clip, EventStream
        >>> class Noise:
        ...     known_truth = ()
        ...     def __len__(self):
        ...         return 2
        ...     def name(self, index):
        ...         return f"noise {index}"
        ...     def read(self, index, truth, most_bytes):
        ...         pixels = np.random.default_rng(index).integers(0, 255, (9, 24, 32), np.uint8)
        ...         return Clip(pixels, np.arange(9) * 40_000)
        >>> stream = EventStream(Noise(), batch=2, frames=4, size="32x24", device="cpu")
        >>> next(iter(stream)).grids.shape
        torch.Size([2, 4, 5, 24, 32])
    """

    known_truth: Sequence[str]
    """Truth that `read` can bring, of `TRUTH`."""

    def __len__(self) -> int:
        """Number of videos."""
        ...

    def name(self, index: int) -> str:
        """Name of one, for messages."""
        ...

    def read(self, index: int, truth: Sequence[str], most_bytes: int) -> Clip:
        """One of them, or as many of its first frames as fit, with their truth, into so many bytes.

        Raises:
            TexventError: it is damaged or cannot be read.
        """
        ...


def find_source(
    source: Any, size: SensorSize, fps: float | None = None, device: str = "cpu"
) -> ClipSource:
    """Clips of whatever names them.

    Args:
        source: a `ClipSource`; the folder of a data set; or what `texvent batch` takes, or several
            of it: a folder of videos or of image folders, a pattern, a file that lists prompts or
            videos.
        size: of the crops, and of the frames of prompts.
        fps: of videos, in place of their own times.
        device: that decodes videos, see `VideoClips`.

    Raises:
        InputError: there is nothing there.
        ConfigError: it is none of these, or prompts and videos are mixed.
    """
    if isinstance(source, ClipSource) and not isinstance(source, str | Path):
        return source
    names = [source] if isinstance(source, str | Path) else source
    if not isinstance(names, list | tuple) or not all(isinstance(n, str | Path) for n in names):
        raise ConfigError(
            "the source must be a folder, a pattern, a file that lists prompts or videos, several "
            f"of these, or a ClipSource such as PromptClips; got {type(source).__name__}"
        )
    if not names:
        raise InputError(
            "the source is an empty list; name a folder, a video or a file that lists some"
        )
    if len(names) == 1 and (Path(names[0]) / SPECIFICATION_FILE).is_file():
        return StoredClips(Path(names[0]))
    entries = [entry for name in names for entry in entries_of(str(name))]
    videos = [entry.video for entry in entries if entry.video is not None]
    if not entries:
        raise InputError(f"there is no video and no prompt in {few([str(name) for name in names])}")
    if 0 < len(videos) < len(entries):
        raise ConfigError("a stream is of prompts or of videos; make one of each")
    if videos:
        return VideoClips(videos, fps, device)
    return PromptClips([entry.subject for entry in entries], sensor=f"{size.width}x{size.height}")


class VideoClips:
    """Video files and folders of images.

    Example:
        >>> from texvent.training import VideoClips
        >>> VideoClips(["street.mp4", "frames/"], fps=24).name(0)
        'street.mp4'
    """

    known_truth: Sequence[str] = ()

    def __init__(
        self, paths: Sequence[str | Path], fps: float | None = None, device: str = "cpu"
    ) -> None:
        """Clips of these paths.

        Args:
            paths: files and folders.
            fps: frame rate, in place of their own times.
            device: a GPU, whose NVDEC decodes where torchcodec is installed; or cpu.

        Raises:
            ConfigError: the rate is out of range.
        """
        self._paths, self._device = paths, device
        self._config = CaptureConfig(fps=None if fps is None else Fraction(fps))

    def __len__(self) -> int:
        """Videos."""
        return len(self._paths)

    def name(self, index: int) -> str:
        """Its path."""
        return str(self._paths[index])

    def read(self, index: int, truth: Sequence[str], most_bytes: int) -> Clip:
        """See `ClipSource`."""
        video = open_frames(self._paths[index], self._config)
        if self._device != "cpu":
            video = decode_video(self._paths[index], video, self._device, most_bytes) or video
        return read_clip(video, truth, most_bytes, None)


class PromptClips:
    """Scenes that the embedded generator renders from prompts, on the CPU, with their truth.

    Example:
        >>> from texvent.training import PromptClips
        >>> len(PromptClips(["a red ball rolls left", "a dog runs"], sensor="32x24"))
        2
    """

    known_truth: Sequence[str] = TRUTH

    def __init__(self, prompts: Sequence[Subject] | Subject, **options: Any) -> None:
        """Clips of prompts or scenes.

        Args:
            prompts: one per clip.
            **options: of `texvent.video`, such as `sensor="160x120"` and `duration=2.0`; `seed` is
                that of the first clip, and each later one has the next.

        Raises:
            ConfigError: one prompt instead of several, or an option is unknown or out of range.
        """
        if isinstance(prompts, str) or not isinstance(prompts, Sequence) or not prompts:
            raise ConfigError("prompts are a list, even of one prompt")
        resolve("generate", options)
        self._prompts, self._options = tuple(prompts), options

    def __len__(self) -> int:
        """Prompts."""
        return len(self._prompts)

    def name(self, index: int) -> str:
        """The prompt."""
        return f"clip of {shown(self._prompts[index])}"

    def read(self, index: int, truth: Sequence[str], most_bytes: int) -> Clip:
        """See `ClipSource`."""
        options = {**self._options, "seed": self._options.get("seed", 0) + index}
        video = api.video(self._prompts[index], **options)
        return read_clip(video, truth, most_bytes, partial(_scene_truth, video))


class StoredClips:
    """The clips of a data set of `texvent dataset make`: frames made again, truth as stored.

    Example:
        >>> from pathlib import Path
        >>> import texvent
        >>> sources = (texvent.dataset.SampleSource(prompts=("a red ball bounces",)),)
        >>> options = {"sensor": "64x48", "duration": 0.2}
        >>> balls = texvent.dataset.Specification(name="balls", sources=sources, options=options)
        >>> work = texvent.dataset.make(balls, "balls", progress=False)
        >>> len(texvent.training.StoredClips(Path("balls")))
        1
    """

    def __init__(self, folder: Path) -> None:
        """Open it.

        Raises:
            InputError: it holds no sample, or its frames cannot be made again.
            FileFormatError: it is damaged.
        """
        dataset = StoredDataset.open(folder)
        self._recipe = load_recipe(dataset.folder)
        self._samples = [
            (shard, sample)
            for shard in dataset.shards(dataset.variants[0])
            for sample in shard.samples
        ]
        if not self._samples:
            raise InputError(f"{folder} holds no sample yet; see texvent dataset stats")
        shard, sample = self._samples[0]
        stored = shard.files(sample).truth().parts
        self.known_truth: Sequence[str] = tuple(name for name in TRUTH if name in stored)

    def __len__(self) -> int:
        """Samples of the first variant."""
        return len(self._samples)

    def name(self, index: int) -> str:
        """Its key."""
        return self._samples[index][1].key

    def read(self, index: int, truth: Sequence[str], most_bytes: int) -> Clip:
        """See `ClipSource`."""
        shard, sample = self._samples[index]
        stored = shard.files(sample).truth()

        def find(t_us: NDArray[np.int64], name: str) -> NDArray[Any]:
            if name == "boxes":
                return stored.boxes
            if not np.array_equal(stored.times_us[: len(t_us)], t_us):
                raise InputError(f"sample {sample.key} stores no truth at the times of its frames")
            if name == "depth":
                return stored.depth()[: len(t_us)]
            return np.moveaxis(stored.flow()[: len(t_us) - 1], -1, 1)

        with clip_frames(self._recipe, shard, sample) as video:
            return read_clip(video, truth, most_bytes, find)


def read_clip(
    video: FrameStream, names: Sequence[str], most_bytes: int, truth: Truth | None
) -> Clip:
    """Decode a video to bytes.

    Args:
        video: checked frames.
        names: parts of the truth to bring.
        most_bytes: of the frames and their truth; those after are left out.
        truth: gives a part.
    """
    is_linear, room = transfer_of(video) is Transfer.LINEAR, most_bytes
    bytes_each = 1 + sum(BYTES_PER_PIXEL[name] for name in names)
    frames: list[NDArray[np.uint8]] = []
    times: list[int] = []
    for frame in video:
        luma = frame.luma
        room -= luma.size * bytes_each
        if room < 0 and len(frames) > 1:
            break
        if is_linear:
            luma = WHITE * np.clip(luma / WHITE, 0, 1) ** (1 / CODING_GAMMA)
        if luma.dtype != np.uint8:
            luma = np.rint(np.clip(luma, 0, WHITE)).astype(np.uint8)
        frames.append(luma.copy())
        times.append(frame.t_us)
    t_us = np.array(times, np.int64)
    found = {name: truth(t_us, name) for name in names} if truth is not None else {}
    return Clip(np.stack(frames), t_us, found)


def _scene_truth(video: Any, times_us: NDArray[np.int64], name: str) -> NDArray[Any]:
    """Truth of the embedded generator's video at its frames."""
    times = times_us.tolist()
    if name == "flow":
        parts = [video.ground_truth(*pair).flow for pair in pairwise(times)]
        return np.moveaxis(np.stack(parts), -1, 1)
    found = [video.ground_truth(t_us, t_us) for t_us in times]
    if name == "depth":
        return np.stack([one.depth for one in found])
    ids = class_ids_of(box.class_name for one in found for box in one.boxes)
    return np.concatenate(
        [np.empty(0, BOX_RECORD)]
        + [
            box_records(t_us, one.boxes, [ids[box.class_name] for box in one.boxes])
            for t_us, one in zip(times, found, strict=True)
        ]
    )
