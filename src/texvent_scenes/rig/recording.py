"""One recording of a rig, not made yet: what its cameras and its IMU will see and when."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import SIMULATORS
from texvent.errors import ConfigError, shown, warn
from texvent.frames import MICROSECONDS, frame_time_us
from texvent.generation.subjects import Subject, prompt_of
from texvent.lens import lens_reach
from texvent.options.values import option_names, plain
from texvent.pipeline import Simulation, text_to_video
from texvent.run.prepare import check_run, prepare_video
from texvent.runtime.identity import derived_seed
from texvent.runtime.progress import Progress
from texvent.sensor import SensorSize
from texvent.settings.config_files import read_document
from texvent.settings.provenance import describe_run
from texvent.settings.resolution import Settings, sensor_preset
from texvent_scenes.procedural import ProceduralVideo
from texvent_scenes.rendered_scene import RenderedScene
from texvent_scenes.rig.config import RigConfig, check_generator
from texvent_scenes.rig.description import (
    IMU_NOISES,
    ImuNoise,
    MountedScene,
    Rig,
    RigCamera,
    body_poses,
    path_lens,
)
from texvent_scenes.rig.imu import (
    ImuSamples,
    sample_times_us,
    true_samples,
    with_noise,
)
from texvent_scenes.rig.kalibr import camera_entries, read_noise, read_rig, stereo_rig
from texvent_scenes.rig.shutter import (
    ExposedFrame,
    Shutter,
    expose_frames,
    frame_times_us,
    make_shutter,
)

POSE_RATE_HZ = 200.0
"""Rate of the true poses where there is no IMU."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Recording:
    """A rig in a scene; nothing is rendered before it is asked for."""

    prompt: str | None
    settings: Settings
    config: RigConfig
    rig: Rig
    """Every camera has a lens."""
    noise: ImuNoise
    video: ProceduralVideo
    """The scene as its own camera sees it."""

    @property
    def stop_us(self) -> int:
        """Time of the last event at most, µs; the first is at 0."""
        return frame_time_us(self.video.frame_count - 1, self.video.fps)

    def scene_of(self, camera: RigCamera) -> RenderedScene:
        """The scene as a camera sees it."""
        return MountedScene(self.video.scene, camera)

    def seed_of(self, part: str) -> int:
        """Seed of a camera's pixels, by its name, or of the IMU's noise ("imu")."""
        return derived_seed("rig", self.settings.run.seed, part)

    def simulation(self, camera: RigCamera, progress: Progress) -> Simulation:
        """The events of a camera, not simulated yet."""
        settings = _with_constants_of(camera.sensor, self.settings)
        run = replace(
            settings.run,
            seed=self.seed_of(camera.name),
            sensor=camera.sensor or str(camera.size),
        )
        metadata = {**self.video.metadata, "camera": camera.name}
        video = replace(
            self.video, scene=self.scene_of(camera), size=camera.size, metadata=metadata
        )
        settings = replace(settings, run=run)
        fixed = getattr(settings.simulate, "sensor_seed", None)
        if fixed is not None:  # a pattern that stays from run to run, and differs between cameras
            own = replace(settings.simulate, sensor_seed=derived_seed("rig", fixed, camera.name))
            settings = replace(settings, simulate=own)
        return prepare_video(video, settings, prompt=self.prompt, progress=progress)

    def facts(self, camera: RigCamera | None = None) -> dict[str, Any]:
        """Facts of the rig, for files, under "rig"."""
        return {
            "camera": camera.name if camera is not None else None,
            "options": plain(self.config),
            "seed": self.settings.run.seed,
            "cameras": camera_entries(self.rig, {}, has_imu=self.config.imu is not None),
            "imu_noise": plain(self.noise) if self.config.imu is not None else None,
        }

    def provenance(self) -> dict[str, Any]:
        """Provenance of the recording as a whole."""
        return describe_run(self.settings, prompt=self.prompt, source=self.video.metadata)

    def shutter_of(self, camera: RigCamera) -> Shutter:
        """Shutter of a camera's frames."""
        return make_shutter(self.config, camera.size)

    def frame_times(self, camera: RigCamera) -> list[int]:
        """Times of a camera's frames, µs; none where no frames are wanted."""
        if self.config.frames is None:
            return []
        return frame_times_us(self.config.frames, self.shutter_of(camera), self.stop_us)

    def frames(self, camera: RigCamera, progress: Progress) -> Iterator[ExposedFrame]:
        """The frames of a camera."""
        times = self.frame_times(camera)
        options = self.video.config
        made = expose_frames(
            self.scene_of(camera),
            camera.size,
            self.shutter_of(camera),
            times,
            samples=options.samples,
            shadows=options.shadows,
            optics=self.video.optics,
        )
        for number, frame in enumerate(made, 1):
            yield frame
            progress.advance(f"frames of {camera.name}", number, len(times))

    @property
    def pose_times(self) -> NDArray[np.int64]:
        """[n] times of the true poses, µs: those of the IMU's samples."""
        return sample_times_us(self.config.imu or POSE_RATE_HZ, self.stop_us)

    def poses(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """[n, 3] true places, m, and [n, 3, 3] rotations to the world, of the IMU."""
        seconds = self.pose_times / MICROSECONDS
        return body_poses(self.video.scene, self.rig.first_from_imu, seconds)

    @cached_property
    def imu(self) -> ImuSamples | None:
        """Samples of the IMU; None without one."""
        rate = self.config.imu
        if rate is None:
            return None
        exact = true_samples(self.video.scene, self.rig.first_from_imu, self.pose_times)
        return with_noise(exact, self.noise, rate, self.seed_of("imu"))


def prepare_recording(
    prompt: Subject, settings: Settings, config: RigConfig, *, progress: Progress
) -> Recording:
    """A recording with everything about it checked.

    Raises:
        ConfigError: the generator is not the embedded one, the camera zooms, a lens does not fit
            its resolution, or the rig file is wrong.
        InputError: the prompt is not understood, or a file cannot be read.
    """
    check_generator(settings.generator)
    check_run(settings)
    rig, noise = _read(config, settings.size or SensorSize(346, 260))
    # The scene is composed for the first camera's image.
    run = replace(settings.run, sensor=str(rig.cameras[0].size))
    first = settings if rig.cameras[0].size == settings.size else replace(settings, run=run)
    video = text_to_video(prompt, first, progress=progress)
    if not isinstance(video, ProceduralVideo):
        raise ConfigError("the embedded generator was replaced by another one; a rig needs it")
    duration_s = float((video.frame_count - 1) / video.fps)
    cameras = []
    for camera in rig.cameras:
        lens = path_lens(video.scene, camera, duration_s)
        dark = lens_reach(lens, camera.size).dark
        if dark > 0.0:
            warn(
                f"{camera.name}: {dark:.0%} of its pixels look further than 85° from the optical "
                "axis; they stay black"
            )
        cameras.append(replace(camera, lens=lens))
    recording = Recording(
        prompt=prompt_of(prompt),
        settings=settings,
        config=config,
        rig=replace(rig, cameras=tuple(cameras)),
        noise=noise,
        video=video,
    )
    if config.frames is not None and not all(map(recording.frame_times, recording.rig.cameras)):
        raise ConfigError(
            f"no frame at {float(config.frames):g} per second has its whole exposure within the "
            f"{duration_s:g} s of the recording; take a longer duration or a shorter exposure"
        )
    return recording


def _with_constants_of(sensor: str | None, settings: Settings) -> Settings:
    """Settings with the preset of a sensor, if the simulator has one, and the options given."""
    preset = sensor_preset(settings.run.simulator, sensor)
    if preset is None or preset == settings.run.preset:
        return settings
    presets = SIMULATORS.load(settings.run.simulator).presets
    before = presets[settings.run.preset]
    given = {
        name: getattr(settings.simulate, name)
        for name in option_names(type(before))
        if getattr(settings.simulate, name) != getattr(before, name)
    }
    run = replace(settings.run, preset=preset)
    return replace(settings, run=run, simulate=replace(presets[preset], **given))


def _read(config: RigConfig, size: SensorSize) -> tuple[Rig, ImuNoise]:
    """The rig and its IMU's noise that a config names."""
    stated = None
    if config.rig is not None:
        rig, stated = read_rig(config.rig, size)
    elif config.stereo is not None:
        rig = stereo_rig(size, config.stereo)
    else:
        rig = Rig((RigCamera("cam0", size, None),))
    if config.imu_noise in IMU_NOISES:
        is_default = config.imu_noise == RigConfig.imu_noise
        return rig, stated if stated is not None and is_default else IMU_NOISES[config.imu_noise]
    if not config.imu_noise.lower().endswith((".yaml", ".yml", ".toml")):
        raise ConfigError(
            f"imu_noise is {shown(config.imu_noise)}; it must be {', '.join(IMU_NOISES)}, or a "
            "file that ends in .yaml, .yml or .toml"
        )
    document: Mapping[str, Any] = read_document(Path(config.imu_noise))
    inner = document.get("imu0", document)
    return rig, read_noise(inner, config.imu_noise)
