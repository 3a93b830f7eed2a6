"""Small inputs of all commands: clips, images, motion vectors, recordings, options."""

from pathlib import Path

import cv2
import h5py
import numpy as np
from tests.calibrate.known_scenes import simulate_flicker, simulate_static
from tests.capture.motion_vectors import moving_scene
from tests.dataset.conftest import make_set
from tests.scenes.assets.glb_bar import write_bar

import texvent
from texvent.cli.app import main
from texvent.frames import Video
from texvent.io.ros.bag_writer import open_sensor_bag
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator
from texvent.simulation.physical.threshold_map import ThresholdMap, write_threshold_map

RIG = """
cam0:
  camera_model: pinhole
  distortion_model: radtan
  distortion_coeffs: [-0.1, 0.01, 0.0, 0.0]
  intrinsics: [9.0, 9.0, 8.0, 6.0]
  resolution: [16, 12]
"""
SPECIFICATION = """
name = "cars"
samples_per_shard = 1
[options]
duration = 0.1
sensor = "16x12"
samples = 1
interpolate = "none"
[[sources]]
prompts = ["a red car drives left", "a blue bus drives left"]
"""
HEIGHT, WIDTH, FRAMES = 12, 16, 5


def make_inputs(folder: Path) -> None:
    """Write them all into a folder."""
    rng = np.random.default_rng(5)
    _make_clips(folder, rng)
    _make_recordings(folder, rng)
    texts = {
        "times.txt": "0\n20\n30\n40\n55\n",
        "seconds.txt": "0\n0.1\n0.2\n0.3\n0.5\n",
        "options.toml": "contrast_threshold = 0.5\n",
        "prompts.txt": "a red ball bounces\n",
        "rig.yaml": RIG,
        "wand.txt": "a magic wand\n",
        "wug.txt": "a wug and a dog run\n",
        "mask.txt": "3 3\n4 4\n5 5\n",
        "lens.txt": "14 14 8 6 -0.3 0.1 0.01 0.02 0",
        "parts.txt": "0.1\n0.3\n0.5\n",
        "v2e.toml": 'simulator = "v2e"\n',
        "ball.toml": '[[objects]]\nnoun = "ball"\n',
        "cars.toml": SPECIFICATION,
        "wugs.toml": SPECIFICATION.replace("a blue bus drives left", "qwerty zxcv"),
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    (folder / "assets").mkdir()
    write_bar(folder / "assets" / "magic_wand.glb")
    pixels = rng.uniform(0.5, 2.0, (2, HEIGHT, WIDTH))
    write_threshold_map(ThresholdMap(*pixels), folder / "map.npz")
    make_set(folder / "cars", truth=["boxes"])


def _make_clips(folder: Path, rng: np.random.Generator) -> None:
    texture = cv2.resize(rng.uniform(0, 1, (6, 20)).astype(np.float32), (60, HEIGHT))
    seen = np.stack([texture[:, 2 * one : 2 * one + WIDTH] for one in range(FRAMES)])
    is_dark = np.arange(WIDTH) < 8
    levels = np.where(is_dark, 8, 60) + np.where(is_dark, 30, 150) * seen
    clip = levels.astype(np.uint8)
    gains = np.array([1.0, 0.8, 1.1, 0.85, 1.0])[:, None, None]
    film = moving_scene.stack(moving_scene.frame)
    arrays = {
        "clip": clip,
        "flickering": (levels * gains).astype(np.uint8),
        "film": film,
        "cut": np.concatenate([film[:3], 255 - film[3:, ::-1, ::-1]]),
    }
    for name in ("forward", "backward", "depth", "instances"):
        arrays[name] = moving_scene.stack(getattr(moving_scene, name))
    for name, array in arrays.items():
        np.save(folder / f"{name}.npy", array)
    (folder / "frames").mkdir()
    for number, image in enumerate(clip):
        cv2.imwrite(str(folder / "frames" / f"{number}.png"), image)
    cv2.imwrite(str(folder / "still.png"), cv2.resize(clip[0], (48, 36)))


def _make_recordings(folder: Path, rng: np.random.Generator) -> None:
    frames = np.load(folder / "clip.npy")
    for name, seed in (("events", 1), ("others", 2)):
        texvent.simulate(frames, fps=5, seed=seed, noise_rate_hz=2.0).save(folder / f"{name}.h5")
    events = texvent.load(folder / "events.h5")
    rows = zip(events.t.tolist(), events.x, events.y, events.p, strict=True)
    text = "".join(f"{t} {x} {y} {p}\n" for t, x, y, p in rows)
    (folder / "plain.csv").write_text(text)
    lines = text.splitlines(keepends=True)
    swapped = "".join([*lines[9:12], *lines[:9]]).replace(" ", ",")
    (folder / "damaged.csv").write_text(f"t,x,y,p\n{swapped}")
    (folder / "odd.csv").write_text(
        "".join(
            f"{x} {y} {t} {p}\n"
            for t, x, y, p in zip(events.t.tolist(), events.x, events.y, events.p, strict=True)
        )
    )
    with open_sensor_bag(folder / "images.bag", "rosbag1") as bag:
        for name in ("left", "right"):
            images = np.zeros((2, 8, 9), np.uint8), np.full((2, 8, 9), 200, np.uint8)
            bag.add_images(f"/{name}", name, [(n * 10**6, one[0]) for n, one in enumerate(images)])
    with h5py.File(folder / "several.h5", "w") as file:
        for name in ("left", "right"):
            for column in "xytp":
                file[f"{name}/{column}"] = getattr(events, column)
    words = ["generate", "a football bounces", "--sensor", "16x12", "--duration", "0.2", "-q"]
    words += ["--samples", "1"]
    flat = ["--previews", "none", "--interpolate", "none"]
    assert main([*words, *flat, "-o", str(folder / "scene.h5")]) == 0
    assert main([*words, "--video-only", "-o", str(folder / "scene.avi")]) == 0
    noise = {"noise_curve": "128:2", "noise_scale": 1.0}
    config = PhysicalConfig(gamma=1.0, contrast_threshold=0.3, **noise)
    size = texvent.SensorSize(16, 12)
    rest_scene = simulate_static(config, size, 2.0)
    rest_scene.save(folder / "rest.npz")
    rest_scene.without_label().save(folder / "rest.csv")
    simulate_static(config, size, 2.0, seed=1).save(folder / "calm.npz")
    simulate_flicker(config, size, 5.0, ratio=6.0, number=6).save(folder / "flicker.npz")
    y, x = np.mgrid[:16, :20]
    waves = [np.sin(0.6 * (x - i)) + np.sin(0.5 * (y + 0.6 * i)) for i in range(50)]
    moving = np.exp(3.5 + np.stack(waves)).astype(np.uint8)
    np.save(folder / "moving.npy", moving)
    video = Video(moving, [i * 20_000 for i in range(len(moving))])
    sensor = PhysicalSimulator(PhysicalConfig(gamma=1.0, contrast_threshold=0.35), seed=3)
    texvent.EventStream.concat([sensor.step(frame) for frame in video]).save(folder / "moving.npz")
