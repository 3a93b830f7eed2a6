"""Calibrate `physical` to the sensor that makes the benchmark's true events.

    python -m texvent_lab.measure.oracle_sensor

writes lab/src/texvent_lab/bench/oracle/sensor.toml and, beside it, sensor_thresholds.npz.

It follows docs/calibration.md with recordings that the benchmark does not score: a field at rest,
without frames; a camera at rest before a texture of which one half moves, with the frames of an
ordinary camera, which tell the balance; a field that flickers, without frames; and the texture
again, now that the bandwidth is known.
"""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path

import numpy as np

from texvent.calibrate.estimates import describe_scene, write_preset
from texvent.calibrate.events_only.flicker import measure_flicker
from texvent.calibrate.events_only.static_scene import measure_static_scene
from texvent.calibrate.fit import describe_fit, fit_sensor
from texvent.calibrate.recording import CalibrationRecording
from texvent.config import InterpolateConfig
from texvent.events import EventStream
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.threshold_map import write_threshold_map
from texvent_lab.bench.fidelity.entries import SENSOR_FILE, THRESHOLD_FILE
from texvent_lab.bench.oracle.pixel import NOISY, REFERENCE_SEED
from texvent_lab.bench.oracle.recording import FPS, SIZE, record, render_video
from texvent_lab.bench.oracle.scenes import (
    EXPOSURE,
    Float64Array,
    Scene,
    ValueNoise,
    panning_texture,
)

FLICKER_HZ, RATIO, BRIGHT = 4.0, 5.0, 1 / EXPOSURE
"""Bright is what the camera shows as white."""
FRAMES = 2 * int(FPS) + 1
REST_FRAMES = 10 * int(FPS) + 1
TEXTURE = 7
"""The texture on which the benchmark fits thresholds; others are scored."""
FRAMES_PER_PIXEL = 2.0
"""Frames per pixel of motion, while frames are compared with events: what fine texture does between
them counts."""
VELOCITY = (60.0, 14.0)
"""Velocity of the half that moves, px/s."""


def flickering_field(seconds: float) -> Float64Array:
    """Radiance of a flat field, bright for the first half of each cycle."""
    is_bright = seconds * FLICKER_HZ % 1.0 < 0.5
    return np.full(SIZE.shape, BRIGHT if is_bright else BRIGHT / RATIO)


def field_at_rest(seconds: float) -> Float64Array:
    """Radiance of a flat field under steady light."""
    del seconds
    return np.full(SIZE.shape, BRIGHT / RATIO)


def half_moving(seconds: float) -> Float64Array:
    """A texture from dark to over-range light, its lower half in motion."""
    noise = ValueNoise(TEXTURE)
    image = panning_texture(noise, SIZE, 0.0, (0.0, 0.0))
    moving = panning_texture(noise, SIZE, seconds, VELOCITY)
    half = SIZE.height // 2
    image[half:] = moving[half:]
    return image * np.linspace(0.05, 1.8, SIZE.width)


def recorded(scene: Scene, frames: int = FRAMES) -> EventStream:
    """Events of the benchmark's sensor during so many frames of its camera."""
    return record(scene, {"events": (NOISY, REFERENCE_SEED)}, frames=frames)["events"]


def main() -> None:
    """Write both files."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, default=SENSOR_FILE.parent)
    folder = parser.parse_args().folder
    video = render_video(half_moving, frames=FRAMES)
    interpolate = InterpolateConfig(frames_per_pixel=FRAMES_PER_PIXEL)
    recording = CalibrationRecording(video, recorded(half_moving), interpolate)
    rest = measure_static_scene(recorded(field_at_rest, REST_FRAMES), PhysicalConfig())
    first = fit_sensor(recording, start=rest.config, report=print).config
    flicker = measure_flicker(recorded(flickering_field), first, hz=FLICKER_HZ, ratio=RATIO)
    pixels = write_threshold_map(flicker.thresholds, folder / THRESHOLD_FILE.name, overwrite=True)
    start = dataclasses.replace(flicker.config, threshold_map=pixels)
    fit = fit_sensor(recording, start=start, keep=["cutoff_hz"], report=print)
    # Its camera has no grain, so pixels may begin anywhere; entries name the map's place.
    config = dataclasses.replace(fit.config, initial_phase="random", threshold_map=None)
    source = "the benchmark's sensor"
    lines = [
        *describe_scene(rest, f"{source}, a field at rest"),
        *describe_scene(flicker, f"{source}, a field that flickers"),
        *describe_fit(
            fit,
            "a texture of which one half moves, see lab/src/texvent_lab/measure/oracle_sensor.py",
        ),
    ]
    write_preset(config, lines, folder / SENSOR_FILE.name, size=SIZE, overwrite=True)


if __name__ == "__main__":
    main()
