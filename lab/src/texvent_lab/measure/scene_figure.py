"""Figure of embedded scenes for docs/prompts.md: stills above, the truth of the first one below.

python -m texvent_lab.measure.scene_figure -o docs/images/generator.png
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.generate.procedural import ProceduralVideo
from texvent.scenes.raycast.ground_truth import GroundTruth

PROMPTS = (
    "tracking shot of a red car driving left past two trees",
    "a woman plays the guitar",
    "a dog runs through a hula hoop",
    "a hand shows a victory sign",
)
SIZE = (240, 180)
AT_US = 600_000
STEP_US = 20_833
Image = NDArray[np.uint8]


def main() -> None:
    """Draw the figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--out", type=Path, required=True)
    out = parser.parse_args().out
    videos = [_open(prompt) for prompt in PROMPTS]
    stills = [_still(video, AT_US) for video in videos]
    truth = videos[0].ground_truth(AT_US, AT_US + STEP_US)
    below = [_draw_depth(truth), _draw_instances(truth), _draw_flow(truth), _draw_change(videos[0])]
    picture = np.vstack([np.hstack(stills), np.hstack(below)])
    cv2.imwrite(str(out), picture)


def _open(prompt: str) -> ProceduralVideo:
    video = texvent.video(prompt, duration=2.0, sensor=f"{SIZE[0]}x{SIZE[1]}", seed=1)
    if not isinstance(video, ProceduralVideo):
        raise TypeError("the prompt was not staged by the embedded generator")
    return video


def _still(video: ProceduralVideo, t_us: int) -> Image:
    return np.asarray(np.clip(video.at(t_us).pixels, 0, 255)[..., ::-1].round(), dtype=np.uint8)


def _draw_depth(truth: GroundTruth) -> Image:
    near = np.where(np.isfinite(truth.depth), 255.0 * 4.0 / (4.0 + truth.depth), 0.0)
    return cv2.applyColorMap(near.astype(np.uint8), cv2.COLORMAP_VIRIDIS).astype(np.uint8)


def _draw_instances(truth: GroundTruth) -> Image:
    hues = (truth.instance * 47 % 180).astype(np.uint8)
    full = np.where(truth.instance > 0, 255, 0).astype(np.uint8)
    light = np.where(truth.instance > 0, 230, 60).astype(np.uint8)
    hsv = np.stack([hues, full, light], axis=-1)
    return cv2.cvtColor(hsv, cv2.COLOR_HSV2BGR).astype(np.uint8)


def _draw_flow(truth: GroundTruth) -> Image:
    x, y = np.nan_to_num(truth.flow[..., 0]), np.nan_to_num(truth.flow[..., 1])
    length = np.hypot(x, y)
    hue = ((np.degrees(np.arctan2(y, x)) % 360.0) / 2.0).astype(np.uint8)
    share = np.clip(255.0 * length / max(float(np.percentile(length, 99.0)), 1e-6), 0, 255)
    hsv = np.stack([hue, share.astype(np.uint8), np.full_like(hue, 255)], axis=-1)
    return cv2.cvtColor(hsv, cv2.COLOR_HSV2BGR).astype(np.uint8)


def _draw_change(video: ProceduralVideo) -> Image:
    """Events of about 20 ms: brighter red, darker blue."""
    before, after = (np.log(video.at(t).luma + 12.0) for t in (AT_US, AT_US + STEP_US))
    change = np.asarray(after - before)
    picture = np.full((*change.shape, 3), 255, dtype=np.uint8)
    picture[change > 0.2] = (60, 60, 220)
    picture[change < -0.2] = (220, 90, 30)
    return picture


if __name__ == "__main__":
    main()
