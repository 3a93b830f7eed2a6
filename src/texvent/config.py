"""Stage configurations: frozen dataclasses that the command line, config files and API share.

A field is one option. Its name is the flag (`max_intermediate` → `--max-intermediate`), the key
in a TOML or YAML file and the keyword in Python; its default is written once, here or in the
part's own file (every generator and simulator declares its `config_type` beside its code); the
text under it is its help. Field names are therefore unique across stages. `options/values.py` reads
the fields, `options/values.py` converts their values.
"""

from __future__ import annotations

import math
import numbers
import typing
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, ClassVar, Literal, TypeAlias

from texvent._registry import suggest
from texvent.errors import ConfigError, shown, warn
from texvent.options.values import types_of
from texvent.runtime.devices import check_device_name

IdleOptions: TypeAlias = Mapping[str, tuple[str, tuple[str | float | None, ...]]]
"""Option → another one, of this or another config, and those of its values (of paths: endings) with
which the first one has no effect; a config has them as `idle_with`."""
UNITS = {
    "duration": " s",
    "start": " s",
    "stop": " s",
    "fps": " frames per second",
    "target_rate": " events per second",
}
"""Units in errors, of options whose names have none."""
FPS_RANGE = Fraction(1, 10**9), 1e6
"""Frame rates, 1/s: from one frame in 32 years to one in a microsecond."""
CAMERA_AMPLITUDES = 1e-6, 1e6
"""Sizes of camera paths, px, or px/s of a pan."""


def check_range(
    name: str, value: float | Fraction | None, low: float | Fraction, high: float = math.inf
) -> None:
    """Refuse an option outside `low..high` (both allowed), NaN and infinity; None is not given.

    Raises:
        ConfigError: with the option's name, its value and the range, or that it is no number.
    """
    if value is not None and not isinstance(value, numbers.Real):
        raise ConfigError(f"{name} is {shown(value)}; it must be a number")
    if value is not None and not (low <= value <= high and value != math.inf):
        allowed = f"at least {low:g}" if high == math.inf else f"{_number(low)}..{_number(high)}"
        if value == math.inf:
            allowed += " and finite"
        said, unit = _number(value), UNITS.get(name, "")
        if said in (_number(low), _number(high)):  # it differs in later digits only
            said = shown(value)
        raise ConfigError(f"{name} is {said}{unit}; it must be {allowed}{unit}")


def check_whole(name: str, value: Any, low: float = -math.inf, high: float = math.inf) -> None:
    """Refuse what is no whole number in `low..high` (both allowed).

    Raises:
        ConfigError: with the option's name, its value and what is allowed.
    """
    is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
    if not (is_number and math.isfinite(value) and value == int(value)):
        raise ConfigError(f"{name} is {shown(value)}; it must be a whole number")
    check_range(name, value, low, high)


def _number(value: float | Fraction) -> str:
    """A number as messages say it, however many digits it has."""
    if value == 2**63 - 1 and isinstance(value, int):
        return "2^63 - 1"
    try:
        return f"{float(value):g}"
    except OverflowError:
        return "a number of more than 300 digits"


def check_choices(config: object) -> None:
    """Refuse an option of type `Literal` that has none of the values it lists.

    Raises:
        ConfigError: with the option's name, its value and what is allowed.
    """
    for name, hint in types_of(type(config)).items():
        value, allowed = getattr(config, name), typing.get_args(hint)
        if typing.get_origin(hint) is Literal and value not in allowed:
            raise ConfigError(f"{name} is {shown(value)}; {suggest(value, allowed)}")


def warn_of_idle(configs: Iterable[Any], given: Iterable[str]) -> None:
    """Warn of options that another one switches off, unless they have their default value.

    Args:
        configs: with the values of all options.
        given: names of those that were given.

    Warns:
        TexventWarning: one has no effect.
    """
    configs = list(configs)
    for name in sorted(given):
        for config in configs:
            decider, values = getattr(config, "idle_with", {}).get(name, ("", ()))
            if getattr(type(config), name, ...) == getattr(config, name, None):
                continue
            owner = next((config for config in configs if hasattr(config, decider)), None)
            value = getattr(owner, decider, "")
            value = value.suffix.lower() if isinstance(value, Path) else value
            if value in values:
                said = "is not given" if value is None else f"is {value}"
                warn(f"{name} has no effect: {decider} {said}")


@dataclass(frozen=True, kw_only=True)
class RunConfig:
    """General options."""

    input_texts: ClassVar[tuple[str, ...]] = ("sensor",)

    simulator: str = "texvent"
    """Pixel model, which turns brightness into events: texvent, physical, esim, v2e, voltmeter or
    senpi."""
    preset: str = "accurate"
    """Set of simulator options; --help run lists them. Single options override it. Without
    simulator it is that of the one that has the preset."""
    sensor: str | None = None
    """Sensor: name or WIDTHxHEIGHT. Names are those of cameras, such as davis346, and of files of
    texvent calibrate. Frames are fitted to its size, and a simulator that knows its measured
    constants uses them. Without it, a video keeps its size and a generated scene is davis346."""
    seed: int = 0
    """Seed of everything random. The same seed and options give the same events, with any number
    of threads and on any machine; GPUs round intermediate frames differently (docs/gpu.md)."""
    keep_events: Literal["all", "signal", "noise"] = "all"
    """Events to keep: all, only those that a brightness change fired, or only noise."""
    label_noise: bool = False
    """Store beside every event whether it is signal (0) or noise (1), as an extra column."""
    target_rate: float | None = None
    """Events per second to aim for: the contrast threshold is adjusted on the first second."""
    randomize: Literal["none", "stoffregen", "v2v"] = "none"
    """Draw contrast thresholds and noise from the seed, for training sets: in the ranges of
    Stoffregen 2020 or of V2V. The drawn values replace those given and are stored."""
    device: str = "auto"
    """Device of pixel model and rife: auto, cpu, cuda, cuda:N; docs/gpu.md."""

    def __post_init__(self) -> None:
        check_device_name(self.device)
        check_range("seed", self.seed, 0, 2**63 - 1)
        check_range("target_rate", self.target_rate, 1e-3, 1e12)


@dataclass(frozen=True, kw_only=True)
class ReadingConfig:
    """Reading of frames from a video, a folder, an array or a camera."""

    fps: Fraction | None = None
    """Frame rate, as 24, 29.97 or 30000/1001. Needed for image folders and arrays without
    timestamps; for a video it overrides the file's own times (for slow-motion footage)."""
    timestamps: Path | None = None
    """Text file with one frame time per line (a file name may follow, as in images.txt)."""
    timestamps_unit: Literal["s", "ms", "us", "ns"] | None = None
    """Unit of the times in that file; without it s, and more than a minute between frames is
    refused with the likely unit."""
    start: float = 0.0
    """Skip this many seconds of input."""
    stop: float | None = None
    """Stop at this time of the input, in seconds."""
    topic: str | None = None
    """Topic of a ROS bag whose images are the frames, where several have images."""
    white_level: float | None = None
    """Value that means white: 1 for floats from 0 to 1, 4095 for 12 bits stored in 16. Without it,
    white is 255 (8-bit and float), 65535 (16-bit), 1 (.exr, .hdr), 203 cd/m² (PQ) or 0.265 of the
    peak (HLG), and floats that never exceed 1 are refused."""
    transfer: Literal["auto", "gamma", "srgb", "linear", "pq", "hlg"] = "auto"
    """Coding of pixels. All but gamma become linear light, also above white; gamma is ordinary
    video. auto: .exr and .hdr are linear, video is what its file says, all else is gamma."""

    def __post_init__(self) -> None:
        check_range("start", self.start, 0.0)
        check_range("stop", self.stop, 0.0)
        check_range("white_level", self.white_level, 1e-9, 1e9)
        check_range("fps", self.fps, *FPS_RANGE)
        if self.stop is not None and not self.stop > self.start:
            raise ConfigError(f"stop is {self.stop:g} s; it must be after start ({self.start:g} s)")


@dataclass(frozen=True, kw_only=True)
class CaptureConfig(ReadingConfig):
    """Frames read, fitted to the sensor, and moved."""

    idle_with: ClassVar[IdleOptions] = {"fit": ("sensor", (None,))}

    fit: Literal["cover", "contain", "stretch"] = "cover"
    """Fit of frames to the sensor's size: cut the excess, add black bars, or distort."""
    motion: Path | None = None
    """Motion vectors of a renderer, instead of optical flow. A folder (.exr, .npy, .npz), a pattern
    such as 'out/flow_*.npy', or one file (.npy, .npz). Depth and ids in the same files are
    used too."""
    motion_back: Path | None = None
    """Vectors to the previous frame, where they are in files of their own."""
    motion_convention: str | None = None
    """Convention of the vectors: blender, carla, unreal or isaac, or words such as
    backward,ndc,y-up (see docs/renderers.md). Without it, pixels to the next frame, x right, y
    down; OpenEXR passes say it themselves."""
    check_motion: bool = True
    """Compare warped with real frames, and refuse vectors if another convention fits clearly
    better."""
    depth: Path | None = None
    """Depth along the optical axis, m, in files as --motion, or .png; decides what is in front."""
    depth_scale: float | None = None
    """Metres per stored step of depth: 0.001 for mm. Needed for PNG."""
    instances: Path | None = None
    """Ids of objects, in files as --motion, or .png."""
    camera: str | None = None
    """Over a still image: saccade, shake or pan. The camera moves as N-MNIST's sensor did, as if
    held by hand, or to the right."""
    camera_amplitude: float | None = None
    """Size of the movement, px: the longest saccade (5.5), the shake's root mean square (2), or the
    pan's px per second (60)."""
    duration: float | None = None
    """Duration of the camera's motion, s. Without it, that of its path: 0.315 (saccade) or 1
    (shake, pan)."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("depth_scale", self.depth_scale, 1e-9, 1e9)
        check_range("camera_amplitude", self.camera_amplitude, *CAMERA_AMPLITUDES)
        check_range("duration", self.duration, 1e-6, 86_400.0)


@dataclass(frozen=True, kw_only=True)
class InterpolateConfig:
    """Intermediate frames: their number and their contents."""

    idle_with: ClassVar[IdleOptions] = {
        **dict.fromkeys(
            ("interpolator_weights", "rife_flow"),
            ("interpolate", ("none", "blend", "flow", "exact", "motion")),
        ),
        "fixed_count": ("interpolate", ("none",)),
        "max_intermediate": ("interpolate", ("none",)),
        "frames_per_pixel": ("interpolate", ("none",)),
    }

    interpolate: str = "flow"
    """Interpolator between frames: none, blend, flow, rife, motion or exact. Blend mixes
    both; flow compensates motion by DIS optical flow; rife (the paper's choice) is a trained
    network; motion follows vectors that come with the frames; with exact the generator renders the
    instant itself."""
    fixed_count: int | None = None
    """Intermediate frames per pair, always so many (10 is the paper's ablation E7). Without it, as
    many as the brightness change needs (Eq. 4)."""
    max_intermediate: int = 64
    """Upper limit of Eq. 4's count per pair."""
    frames_per_pixel: float | None = None
    """Intermediate frames per pixel that the fastest part of a pair moves (DIS optical flow), at
    least: 1 keeps thin and faint things from jumping over pixels, 2 shows all that fine texture
    does; 0 is Eq. 4's count alone. Without it, models whose pixels may fire several times per
    frame get 1, up to twice Eq. 4's count."""
    deflicker: bool = False
    """Divide fast changes of the whole image's brightness out of the frames, before they are
    counted and simulated: generated video flickers. Fades stay, a little later."""
    detect_cuts: bool = True
    """Detect scene cuts and flashes and let them happen at one instant instead of smearing them
    over the frame interval."""
    interpolator_weights: Path | None = None
    """Weights of rife. Without it, those that texvent weights pull fetched."""
    rife_flow: Literal["once", "each"] = "once"
    """Motion that rife estimates: once per pair, or anew for each intermediate frame (each), as in
    the paper: slower, and differences between the estimates flicker."""

    def __post_init__(self) -> None:
        check_choices(self)
        if self.deflicker and self.interpolate == "exact":
            raise ConfigError(
                "deflicker corrects the frames of a video, and exact frames are rendered; "
                "leave it out, or choose another interpolate"
            )
        check_range("frames_per_pixel", self.frames_per_pixel, 0.0, 100.0)
        check_range("fixed_count", self.fixed_count, 0, 10_000)
        check_range("max_intermediate", self.max_intermediate, 0, 10_000)
