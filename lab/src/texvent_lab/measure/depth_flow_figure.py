"""Draw what trained networks of depth and flow make of unseen scenes, beside the truth.

    python -m texvent_lab.measure.depth_flow_figure flow.toml flow depth.toml depth FIGURE.png

flow and depth are folders of trainings. It needs torch: pip install 'texvent-lab[train]'.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.metrics.dense_errors import FARTHEST_M
from texvent_lab.measure.depth_flow import angle, load_depth, load_flow, torch
from texvent_lab.train.checkpoint import WEIGHTS_FILE
from texvent_lab.train.depth.config import DepthConfig
from texvent_lab.train.depth.log_depth import decode_depth
from texvent_lab.train.flow.config import FlowConfig
from texvent_lab.train.reading import read_training
from texvent_lab.train.sequences.truth import GRIDS, TruthExamples

colours: Any = require("matplotlib.colors", extra="train")
Figure: Any = require("matplotlib.figure", extra="train").Figure
SPLIT, CLIPS, WINDOW = "test", (1, 2, 3, 15), 12
"""Which scenes, and the window of each that is drawn."""
FASTEST_PX, NEAREST_M = 5.0, 1.0
TITLES = ("events", "true flow", "flow found", "true depth", "depth found")


def main() -> None:
    """Write the figure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("flow_file", "flow", "depth_file", "depth", "figure"):
        parser.add_argument(name, type=Path)
    options = parser.parse_args()
    with torch.inference_mode():
        figure = draw(options.flow_file, options.flow, options.depth_file, options.depth)
    figure.savefig(options.figure, dpi=80)


def draw(flow_file: Path, flow: Path, depth_file: Path, depth: Path) -> Any:
    """A row per clip; hue is direction, saturation speed."""
    figure = Figure(figsize=(11, 1.5 * len(CLIPS) + 0.3), layout="constrained")
    axes = figure.subplots(len(CLIPS), len(TITLES), squeeze=False)
    flow_data = read_training(flow_file, FlowConfig()).data
    flows = TruthExamples.open(flow_data, SPLIT, "flow", 5, is_whole=True)
    depth_data = read_training(depth_file, DepthConfig()).data
    depths = TruthExamples.open(depth_data, SPLIT, "depth", 5, is_whole=True)
    networks = load_flow(flow / WEIGHTS_FILE), load_depth(depth / WEIGHTS_FILE)
    chance = np.random.default_rng(0)
    image = None
    for row, clip in zip(axes, CLIPS, strict=True):
        moving, far = flows(clip, chance), depths(clip, chance)
        grids = torch.from_numpy(far[GRIDS])[None]
        found_flow = networks[0](torch.from_numpy(moving[GRIDS][WINDOW : WINDOW + 1]))[-1][0]
        found_depth = decode_depth(networks[1](grids[:, : WINDOW + 1])[0, -1, 0])
        row[0].imshow(-moving[GRIDS][WINDOW].sum(axis=0), cmap="RdBu_r", vmin=-4, vmax=4)
        for axis, one in zip(row[1:3], (moving["flow"][WINDOW], found_flow.numpy()), strict=True):
            axis.imshow(flow_colours(one))
        for axis, one in zip(row[3:], (far["depth"][WINDOW, 0], found_depth.numpy()), strict=True):
            shown = np.where(one < FARTHEST_M, one, np.nan)
            image = axis.imshow(
                shown, cmap="viridis_r", norm=colours.LogNorm(NEAREST_M, FARTHEST_M)
            )
    for axis, title in zip(axes[0], TITLES, strict=True):
        axis.set_title(title)
    for axis in axes.flat:
        axis.set_xticks([])
        axis.set_yticks([])
    figure.colorbar(image, ax=axes[:, 3:], label="m", shrink=0.9)
    return figure


def flow_colours(flow: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Red is right, lime down, cyan left, violet up, white still. [H, W, 3] of [2, H, W]."""
    known = np.nan_to_num(flow)
    hue = (angle(known) / (2 * np.pi)) % 1
    speed = np.clip(np.hypot(*known) / FASTEST_PX, 0, 1)
    return np.asarray(colours.hsv_to_rgb(np.stack([hue, speed, np.ones_like(hue)], axis=-1)))


if __name__ == "__main__":
    main()
