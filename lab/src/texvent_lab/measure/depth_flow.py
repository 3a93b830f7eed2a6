"""What trained networks of depth and flow are worth: beside trivial predictors, and on a recording.

    python -m texvent_lab.measure.depth_flow [--json FILE] scenes flow.toml flow depth.toml depth
    python -m texvent_lab.measure.depth_flow [--json FILE] slider FOLDER flow depth

flow and depth are folders of trainings. FILE keeps what the other command wrote. FOLDER holds
`events.txt` of a camera that slides sideways before a still scene, such as slider_depth of the
Event-Camera Dataset (240x180 px). There, flow is compared with the velocity along which the events
of each patch are sharpest, and depth with the inverse of that velocity: up to a factor, both are
the same. It needs torch: pip install 'texvent-lab[train]'.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.events import EventStream
from texvent.extending import full_version, require
from texvent.metrics.event_sharpness import (
    estimate_patch_flow,
    estimate_velocity,
    splat_events,
)
from texvent.represent.event_frame import count_events
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.video import MICROSECONDS
from texvent_lab.bench.machine import describe_environment
from texvent_lab.train.checkpoint import WEIGHTS_FILE
from texvent_lab.train.depth.config import DepthConfig
from texvent_lab.train.depth.e2depth import make_e2depth
from texvent_lab.train.depth.log_depth import decode_depth, encode_depth
from texvent_lab.train.depth.task import DepthTask
from texvent_lab.train.flow.config import FlowConfig
from texvent_lab.train.flow.ev_flow_net import PREFIX, make_ev_flow_net
from texvent_lab.train.flow.task import FlowTask
from texvent_lab.train.history import HISTORY_FILE
from texvent_lab.train.reading import read_training
from texvent_lab.train.sequences.truth import TruthExamples

torch: Any = require("torch", extra="train")
Array = NDArray[Any]
CPU = torch.device("cpu")
SENSOR = (240, 180)
SLICE_US = 25_000
"""Of the recording: half that of training, for what is twice as wide moves twice as many pixels."""
WINDOW_US, PATCH_PX, WINDOWS = 40_000, 45, 24
"""Of the reference: long enough for a sharp peak, small enough for one depth per patch."""
LEAST_PATCHES = 5
"""Windows with fewer patches that have enough events are left out."""
LEAST_SPEED = 20.0
"""Slower patches, px/s, are the reference's failures: nothing in the scene is that far away."""


def main() -> None:
    """Print the scores, and write them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", type=Path)
    commands = parser.add_subparsers(dest="command", required=True)
    scenes = commands.add_parser("scenes")
    scenes.add_argument("--split", default="test", help="scored; default: %(default)s")
    slider = commands.add_parser("slider")
    slider.add_argument("recording", type=Path, help="folder of the recording")
    for name in ("flow", "depth"):
        scenes.add_argument(f"{name}_file", type=Path, help="training file")
        for command in (scenes, slider):
            command.add_argument(name, type=Path, help="folder of the training")
    options = parser.parse_args()
    with torch.inference_mode():
        if options.command == "scenes":
            found: Any = {
                "flow": score_flow(options.flow_file, options.flow, options.split),
                "depth": score_depth(options.depth_file, options.depth, options.split),
            }
        else:
            weights = (folder / WEIGHTS_FILE for folder in (options.flow, options.depth))
            found = score_slider(options.recording, *weights)
    print(json.dumps(found, indent=1))
    if options.json:
        known = json.loads(options.json.read_text("utf-8")) if options.json.exists() else {}
        environment = {**describe_environment(), "full_version": full_version()}
        document = {**known, "environment": environment, options.command: found}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def score_flow(path: Path, folder: Path, split: str) -> dict[str, Any]:
    """Scores of a trained network, and of no motion and the training split's mean flow."""
    config = _with_split(read_training(path, FlowConfig()), split)
    task, truth = FlowTask(config), _truths(config, "flow")
    mean = np.nanmean(truth, axis=0)
    predictors = {"zero flow": np.zeros_like(mean), "mean flow": mean}
    return {
        "training": trained(folder),
        "split": split,
        "network": _scores(task, load_flow(folder / WEIGHTS_FILE)),
        **{name: _scores(task, _always(one[None])) for name, one in predictors.items()},
    }


def score_depth(path: Path, folder: Path, split: str) -> dict[str, Any]:
    """Scores of a trained network, and of the training split's median depth.

    That is the median of all pixels, and pixel by pixel.
    """
    config = _with_split(read_training(path, DepthConfig()), split)
    task, truth = DepthTask(config), _truths(config, "depth")
    truth[~np.isfinite(truth)] = np.nan
    constant = np.full_like(truth[0], np.nanmedian(truth))
    image = _median(np.moveaxis(truth, 0, -1))
    image[np.isnan(image)] = constant[0, 0, 0]
    codes = {
        name: encode_depth(torch.from_numpy(one)).numpy()
        for name, one in {"median depth": constant, "median depth image": image}.items()
    }
    return {
        "training": trained(folder),
        "split": split,
        "network": _scores(task, load_depth(folder / WEIGHTS_FILE)),
        **{name: _scores(task, _always(one[None, None])) for name, one in codes.items()},
    }


def trained(folder: Path) -> dict[str, Any]:
    """What a training was, and the validation score of every epoch, of which the best is kept."""
    history = json.loads((folder / HISTORY_FILE).read_text(encoding="utf-8"))
    history["training"]["data"].pop("cache", None)
    rows = history.pop("epochs")
    seconds = round(sum(row["seconds"] for row in rows))
    curve = [round(row[history["chosen_by"]], 4) for row in rows]
    return {**history, "seconds": seconds, "curve": curve}


def _with_split(config: Any, split: str) -> Any:
    return replace(config, data=replace(config.data, validation_split=split))


def _truths(config: FlowConfig | DepthConfig, target: Any) -> Array:
    """What is true in all windows of the training split, [windows, channels, H, W]."""
    examples = TruthExamples.open(config.data, config.data.split, target, 1, is_whole=True)
    chance = np.random.default_rng(0)
    return np.concatenate([examples(number, chance)[target] for number in range(len(examples))])


def _scores(task: FlowTask | DepthTask, network: Any) -> dict[str, float]:
    return {name: round(one, 4) for name, one in task.validate(network, CPU, workers=0).items()}


def _always(output: Array) -> Any:
    """A network that gives the same for all windows: flow [1, 2, H, W], depth [1, 1, 1, H, W]."""
    one = torch.from_numpy(output)

    def network(grids: Any) -> Any:
        if one.ndim == 4:
            return (one.expand(len(grids), -1, -1, -1),)
        return one.expand(1, grids.shape[1], -1, -1, -1)

    return network


def score_slider(folder: Path, flow: Path, depth: Path) -> dict[str, Any]:
    """Both networks on a recording of a sliding camera."""
    events = texvent.open(folder / "events.txt", size=SENSOR).collect()
    first, last = int(events.t[0]), int(events.t[-1])
    starts = np.linspace(first + 10 * SLICE_US, last - WINDOW_US, WINDOWS).astype(int)
    flows, depths = load_flow(flow), _all_depths(load_depth(depth), events)
    rows: dict[str, list[float]] = {}
    for start in starts.tolist():
        for name, value in _score_window(events, start, flows, depths).items():
            rows.setdefault(name, []).append(value)
    means = {name: round(float(np.mean(values)), 3) for name, values in rows.items()}
    return {"windows": len(rows["patches"]), "slice_us": SLICE_US, "patch_px": PATCH_PX, **means}


def _score_window(
    events: EventStream, start: int, flow_network: Any, depths: Mapping[int, Array]
) -> dict[str, float]:
    window = events.cut(start, start + WINDOW_US)
    reference = estimate_patch_flow(window, patch_px=PATCH_PX, window_us=WINDOW_US)
    whole = estimate_velocity(window, window_us=WINDOW_US)
    middle = start + WINDOW_US // 2
    near = events.cut(middle - SLICE_US // 2, middle + SLICE_US // 2)
    grid = torch.from_numpy(voxel_e2vid(near, bins=5, normalise=True))[None]
    found = flow_network(grid)[-1][0].numpy() * (MICROSECONDS / SLICE_US)
    seen = np.asarray(count_events(window).any(axis=0))
    depth = depths[min(depths, key=lambda end: abs(end - middle))]
    patches = {"flow": _in_patches(found, seen), "depth": _in_patches(depth[None], seen)}
    known = np.hypot(*np.moveaxis(reference, -1, 0)) >= LEAST_SPEED
    known &= np.isfinite(patches["depth"][0])
    true = reference[known].T
    if known.sum() < LEAST_PATCHES:
        return {}
    seconds = WINDOW_US / MICROSECONDS
    one = np.zeros(2) if whole is None else np.array(whole)
    guesses = {
        "network": patches["flow"][:, known],
        "one velocity": np.broadcast_to(one[:, None], true.shape),
        "zero flow": np.zeros_like(true),
    }
    constant = np.broadcast_to(one[:, None, None], found.shape)
    speed, found_speed = np.hypot(*true), np.hypot(*guesses["network"])
    turns = np.abs(np.angle(np.exp(1j * (angle(guesses["network"]) - angle(true)))))
    return {
        "patches": float(known.sum()),
        "reference px/s": float(np.median(speed)),
        "network px/s": float(np.median(found_speed)),
        "median angle to reference, degrees": float(np.degrees(np.median(turns))),
        **{
            f"EPE of {name}, px in 40 ms": float(np.hypot(*(guess - true)).mean() * seconds)
            for name, guess in guesses.items()
        },
        "rank correlation of speed": rank_correlation(found_speed, speed),
        "rank correlation of depth": rank_correlation(patches["depth"][0, known], 1 / speed),
        "rank correlation of height in the image": rank_correlation(
            -np.nonzero(known)[0], 1 / speed
        ),
        "depth up to a factor, off by %": spread(patches["depth"][0, known] * speed),
        "one depth, off by %": spread(speed),
        "sharpness, network": sharpness(window, found),
        "sharpness, one velocity": sharpness(window, constant),
    }


def sharpness(events: EventStream, flow: Array) -> float:
    """Variance of the image of the events moved back along the flow, over that of the events.

    Args:
        events: a short span.
        flow: px/s, [2, H, W].
    """
    seconds = (events.t - events.t[0]) / MICROSECONDS
    at = flow[:, events.y, events.x]
    pad = int(np.ceil(np.abs(at * seconds).max())) + 1
    shape = tuple(side + 2 * pad for side in events.size.shape)
    images = [
        splat_events(
            events.x - scale * at[0] * seconds + pad,
            events.y - scale * at[1] * seconds + pad,
            (shape[0], shape[1]),
        )
        for scale in (1.0, 0.0)
    ]
    return float(images[0].var() / images[1].var())


def rank_correlation(one: Array, other: Array) -> float:
    """Spearman's rank correlation; equal values share their mean rank."""
    ranks = [
        (values[:, None] > values).sum(axis=1) + 0.5 * (values[:, None] == values).sum(axis=1)
        for values in (one, other)
    ]
    return float(np.corrcoef(*ranks)[0, 1])


def angle(vectors: Array) -> Array:
    """Direction of (x, y), radians, [...] of [2, ...]."""
    return np.asarray(np.arctan2(vectors[1], vectors[0]))


def spread(ratios: Array) -> float:
    """Mean distance from the median, % (of logarithms, so that twice and half are as far)."""
    logs = np.log(ratios)
    return float(100 * np.expm1(np.abs(logs - np.median(logs)).mean()))


def _in_patches(maps: Array, seen: Array) -> Array:
    """Median of maps over the pixels with events of each patch, [channels, rows, columns]."""
    masked = np.where(seen, maps, np.nan)
    rows, columns = (side // PATCH_PX for side in seen.shape)
    cut = masked[:, : rows * PATCH_PX, : columns * PATCH_PX]
    parts = cut.reshape(len(maps), rows, PATCH_PX, columns, PATCH_PX)
    return _median(parts.transpose(0, 1, 3, 2, 4).reshape(len(maps), rows, columns, -1))


def _median(values: Array) -> Array:
    """Over the last axis, of what is not NaN; NaN where nothing is."""
    known = np.isfinite(values).any(axis=-1)
    result = np.full(values.shape[:-1], np.nan, values.dtype)
    result[known] = np.nanmedian(values[known], axis=-1)
    return result


def _all_depths(network: Any, events: EventStream) -> dict[int, Array]:
    """End of each slice, µs → depth there, m, [H, W]; the network sees them in turn."""
    edges = range(int(events.t[0]), int(events.t[-1]), SLICE_US)
    slices = [events.cut(start, start + SLICE_US) for start in edges]
    grids = np.stack([voxel_e2vid(one, bins=5, normalise=True) for one in slices])
    found = decode_depth(network(torch.from_numpy(grids)[None]))[0, :, 0].numpy()
    return {start + SLICE_US: depth for start, depth in zip(edges, found, strict=True)}


def load_flow(path: Path) -> Any:
    """EV-FlowNet of a weights file."""
    content = torch.load(path, weights_only=True)
    wide, bins = content["state_dict"][f"{PREFIX}.encoders.0.conv2d.weight"].shape[:2]
    network = make_ev_flow_net(bins, wide // 2, seed=0)
    network.read(content, path, "")
    return network


def load_depth(path: Path) -> Any:
    """E2Depth of a weights file."""
    content = torch.load(path, weights_only=True)
    network = make_e2depth(content["config"]["model"]["base_num_channels"], seed=0)
    network.read(content, path, "")
    return network


if __name__ == "__main__":
    main()
