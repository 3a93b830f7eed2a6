"""Write the ground truth of a video from Python."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.truth.parts import PARTS, parse_parts
from texvent.truth.writer import TruthWriter
from texvent.video import FrameStream

OF_FRAMES = ",".join(part for part in PARTS if part != "events")
"""What is known without events."""


def save_truth(
    video: FrameStream,
    folder: str | Path,
    parts: str | Iterable[str] = OF_FRAMES,
    *,
    overwrite: bool = False,
) -> Path:
    """Write what is true of a video's scene into a folder, as `texvent generate --truth` does.

    Args:
        video: frames whose truth is known: those of `texvent.video(prompt)`, or a stream of yours
            with `ground_truth(t0_us, t1_us)`, or with `Frame.motion`.
        folder: where to, such as "out.truth".
        parts: flow, flow-back, depth, ids, boxes, poses, overlay, with commas between; default:
            all of them.
        overwrite: whether a folder of truth may be replaced.

    Returns:
        The folder, for `load_truth`.

    Raises:
        ConfigError: an unknown part, or one that the video does not know.
        InputError: a frame does not bring the truth that is asked for.
        OutputError: the folder exists already, or cannot be written.

    Example:
        >>> import tempfile, texvent
        >>> frames = texvent.video("a red ball bounces", sensor="48x36", duration=0.1)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     truth = texvent.load_truth(save_truth(frames, f"{folder}/ball.truth", "boxes"))
        ...     truth, truth.boxes["w"].max() > 0
        (Truth(3 frames, 48x36, boxes), np.True_)
    """
    wanted = parse_parts(parts)
    if not wanted or "events" in wanted:
        raise ConfigError(
            f"parts is {parts!r:.80}; give some of {OF_FRAMES}: instances and classes of events "
            "are written by a run, texvent.generate(..., truth_folder=...)"
        )
    nothing = EventStream.empty(video.size)
    with TruthWriter(
        folder, video, wanted, metadata={"source": video.metadata}, overwrite=overwrite
    ) as writer:
        for frame in video:
            writer.append(frame, nothing)
    return Path(folder)
