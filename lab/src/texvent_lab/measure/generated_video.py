"""Time from the last frame of a video model to the last event, on the device that made it.

The decoder of a pipeline of real size, with random weights, makes noise: the worst case. A texture
that moves stands for a natural video. Weights are never read, nothing is fetched.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import InputError, MissingDependencyError
from texvent.extending import require
from texvent.frames import Video
from texvent.generation.video_models.config import GeneratedVideoConfig
from texvent.generation.videos.retries import generate_checked
from texvent.generation.videos.stored_video import MadeVideo, to_16_bits_there, write_video
from texvent.interpolate.rife.weights import find_rife_weights
from texvent.pipeline import video_to_events
from texvent.runtime.work.side_work import begin_side_work, finish_side_work
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation.gpu.support import RunDevice
from texvent_lab.measure.speed.timing import rounded

EXTRA = "generate"
SIZE = SensorSize(832, 480)


@dataclass(frozen=True)
class Wan:
    """A text-to-video pipeline of Wan 2.1, its published 1.3B size."""

    size: SensorSize = SIZE
    frames: int = 81
    steps: int = 2
    """Denoising steps; not timed."""
    heads: int = 12
    head_width: int = 128
    layers: int = 30
    inner_width: int = 8960
    text_width: int = 4096
    decoder_width: int = 96


def measure_generated(
    wan: Wan, chosen: RunDevice, weights: Path | None = None
) -> Iterator[dict[str, Any]]:
    """Seconds from the last frame to the last event, and to the end of the file, by video.

    Args:
        wan: the pipeline.
        chosen: device of everything.
        weights: those of RIFE; None: those that were pulled. Without any, frames are blended.
    """
    try:
        find_rife_weights(weights)
        interpolate = "rife"
    except InputError:
        interpolate = "blend"
    options = {"device": "cpu", "interpolate": interpolate, "interpolator_weights": weights}
    yield _measure("moving texture", _texture(wan, chosen.gpu), options, chosen)
    yield _measure("moving texture", _texture(wan, chosen.gpu), {"device": "cpu"}, chosen)
    try:
        decoded = _decode(wan, chosen.gpu)
    except MissingDependencyError as error:
        print(f"the pipeline of real size was left out: {error}", file=sys.stderr)
        return
    yield _measure("decoded noise", decoded, options, chosen)


def moving_texture(size: SensorSize, count: int) -> Video:
    """Colour noise of 8 px that moves by 3 px per frame, at 25 frames per second."""
    height, width = size.shape
    random = np.random.default_rng(0)
    cells = random.integers(40, 200, (height // 8 + 2, (width + 3 * count) // 8 + 2, 3))
    wide = np.kron(cells, np.ones((8, 8, 1), np.int64)).astype(np.uint8)
    frames = [wide[:height, 3 * index : 3 * index + width] for index in range(count)]
    return Video(np.stack(frames), [40_000 * index for index in range(count)])


def _measure(name: str, frames: Any, options: dict[str, Any], chosen: RunDevice) -> dict[str, Any]:
    """A row: frames [F, H, W, 3] on the device, 0..1, become events and a file."""
    count, height, width, _ = frames.shape
    settings = resolve("simulate", options)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        started, ended = time.perf_counter(), list[float]()
        made = MadeVideo(
            Fraction(16), SensorSize(width, height), count, levels=to_16_bits_there(frames)
        )

        def store() -> None:
            write_video(made.pixels, folder / "video.avi", made.fps, {}, overwrite=False)
            ended.append(time.perf_counter())

        begin_side_work(folder, store)
        config = GeneratedVideoConfig()
        video = generate_checked(lambda *_: made, config, seed=0, progress=None)
        checked = time.perf_counter()
        events = between = 0
        for frame, packet in replace(video_to_events(video, settings), device=chosen).steps():
            events, between = events + len(packet), between + (not frame.is_source)
        last = time.perf_counter()
        finish_side_work(folder)
    return {
        "video": name,
        "size": f"{width}x{height}",
        "frames": count,
        "interpolate": settings.interpolate.interpolate,
        "frames_between": between,
        "events": events,
        "check_s": rounded(checked - started),
        "last_event_s": rounded(last - started),
        "file_s": rounded(ended[0] - started),
    }


def _texture(wan: Wan, device: Any) -> Any:
    """Blurred noise that moves by 2 px per frame."""
    torch = require("torch", extra=EXTRA)
    width, height = wan.size
    random = torch.Generator("cpu").manual_seed(0)
    cells = torch.rand((1, 3, height // 8 + 2, (width + 2 * wan.frames) // 8 + 2), generator=random)
    wide = torch.nn.functional.interpolate(
        cells.to(device), scale_factor=8.0, mode="bilinear", align_corners=False
    )[0].movedim(0, 2)
    views = [wide[:height, 2 * one : 2 * one + width] for one in range(wan.frames)]
    return torch.stack(views) * 0.6 + 0.2


def _decode(wan: Wan, device: Any) -> Any:
    """Frames that the pipeline's decoder makes, where it leaves them."""
    torch, diffusers = require("torch", extra=EXTRA), require("diffusers", extra=EXTRA)
    half = torch.bfloat16 if device.type == "cuda" else torch.float32
    with device, torch.inference_mode():
        torch.manual_seed(0)
        transformer = diffusers.WanTransformer3DModel(
            num_attention_heads=wan.heads,
            attention_head_dim=wan.head_width,
            num_layers=wan.layers,
            ffn_dim=wan.inner_width,
            text_dim=wan.text_width,
        )
        pipe = diffusers.WanPipeline(
            tokenizer=None,
            text_encoder=None,
            transformer=transformer.to(half).eval(),
            vae=diffusers.AutoencoderKLWan(base_dim=wan.decoder_width).eval(),
            scheduler=diffusers.FlowMatchEulerDiscreteScheduler(shift=3.0),
        )
        pipe.set_progress_bar_config(disable=True)
        words = torch.randn(1, 512, wan.text_width, dtype=half)
        video = pipe(
            prompt_embeds=words,
            guidance_scale=1.0,
            num_inference_steps=wan.steps,
            num_frames=wan.frames,
            width=wan.size.width,
            height=wan.size.height,
            output_type="pt",
            return_dict=False,
        )[0]
    return video[0].movedim(1, 3)
