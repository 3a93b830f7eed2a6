"""Options of the Python API, for editors and type checkers.

The option dataclasses say what each option means, and so does `--help all`; a test compares both.
None means "not given".
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal, TypeAlias, TypedDict, TypeVar

from numpy.typing import NDArray

from texvent.sensor import Sensor

Rate: TypeAlias = int | float | str | Fraction
"""24, 29.97 or "30000/1001"."""
SensorName: TypeAlias = str | Path | Sensor | tuple[int, int]
"""A name such as "davis346", (width, height), or a file that `texvent calibrate` wrote."""
Field: TypeAlias = str | Path | NDArray[Any] | Sequence[NDArray[Any]]
"""Files, or an array [N, H, W] or [N, H, W, 2], or N arrays."""


class RunOptions(TypedDict, total=False):
    """Options of every run."""

    simulator: str | None
    preset: str | None
    sensor: SensorName | None
    seed: int | None
    keep_events: Literal["all", "signal", "noise"] | None
    label_noise: bool | None
    target_rate: float | None
    randomize: Literal["none", "stoffregen", "v2v"] | None
    device: str | None


class InterpolateOptions(TypedDict, total=False):
    """Options of the intermediate frames."""

    interpolate: str | None
    fixed_count: int | None
    max_intermediate: int | None
    frames_per_pixel: float | None
    deflicker: bool | None
    detect_cuts: bool | None
    interpolator_weights: str | Path | None
    rife_flow: Literal["once", "each"] | None


class SimulatorOptions(TypedDict, total=False):
    """Options of all pixel models."""

    contrast_threshold: float | None
    balance: float | None
    cache: Literal["local", "global", "none"] | None
    residual_decay_hz: float | None
    reset: Literal["current", "step"] | None
    multi_event: bool | None
    noise: Literal["adaptive", "gaussian", "random", "none"] | None
    noise_rate_hz: float | None
    noise_scale: float | None
    noise_intensity: float | None
    noise_on_fraction: float | None
    timestamp_rule: Literal["eq7", "random", "linear", "end"] | None
    gamma: float | None
    on_off_ratio: float | None
    threshold_sigma: float | None
    threshold_map: str | Path | None
    initial_phase: Literal["random", "zero"] | None
    cutoff_hz: float | None
    cutoff_limit_hz: float | None
    refractory_period_us: int | None
    leak_rate_hz: float | None
    leak_rate_decades: float | None
    noise_curve: str | None
    noise_decades: float | None
    hot_pixel_fraction: float | None
    hot_pixel_rate_hz: float | None
    sensor_seed: int | None
    scan_period_ns: int | None
    contrast_threshold_on: float | None
    contrast_threshold_off: float | None
    log_eps: float | None
    shot_noise_rate_hz: float | None
    constants: str | None


class ReadingOptions(TypedDict, total=False):
    """Options of how frames are read."""

    fps: Rate | None
    timestamps: str | Path | None
    timestamps_unit: Literal["s", "ms", "us", "ns"] | None
    start: float | None
    stop: float | None
    topic: str | None
    white_level: float | None
    transfer: Literal["auto", "gamma", "srgb", "linear", "pq", "hlg"] | None


class CaptureOptions(ReadingOptions, total=False):
    """Options of recorded frames."""

    fit: Literal["cover", "contain", "stretch"] | None
    motion: Field | None
    motion_back: Field | None
    motion_convention: str | None
    check_motion: bool | None
    depth: Field | None
    depth_scale: float | None
    instances: Field | None
    camera: str | None
    camera_amplitude: float | None
    duration: float | None


class GeneratorOptions(TypedDict, total=False):
    """Options of all generators."""

    generator: str | None
    fps: Rate | None
    duration: float | None
    samples: int | None
    shadows: bool | None
    point_spread: float | None
    vignetting: bool | None
    assets: str | Path | None
    hdr: bool | None
    strict: bool | None
    fit: Literal["cover", "contain", "stretch"] | None
    reuse_video: bool | None
    on_failure: Literal["ignore", "warn", "reject", "retry"] | None
    height: int | None
    frames: int | None
    steps: int | None
    guidance: float | None
    image_first: bool | None
    width: int | None
    negative_prompt: str | None
    image: str | Path | None
    lora: Sequence[str] | None
    control: Literal["depth", "edges", "ids", "flow"] | None
    look: str | None
    scene_seed: int | None
    least_agreement: float | None
    offload: Literal["auto", "none", "model", "sequential"] | None


class SimulateOptions(
    RunOptions, CaptureOptions, InterpolateOptions, SimulatorOptions, total=False
):
    """Options of `texvent.simulate`."""


class GenerateOptions(
    RunOptions, GeneratorOptions, InterpolateOptions, SimulatorOptions, total=False
):
    """Options of `texvent.generate`."""


AnyFunction = TypeVar("AnyFunction", bound=Callable[..., Any])


def naming_options(keywords: type) -> Callable[[AnyFunction], AnyFunction]:
    """A decorator that puts the keys of a TypedDict into the signature, before `**options`.

    Type checkers read `Unpack[...]` themselves; IPython and `inspect.signature` do not.

    Example:
        >>> from typing import TypedDict
        >>> class Options(TypedDict, total=False):
        ...     seed: int | None
        >>> @naming_options(Options)
        ... def run(source, **options): ...
        >>> inspect.signature(run)
        <Signature (source, *, seed: 'int | None' = None, **options)>
    """

    def name(function: AnyFunction) -> AnyFunction:
        plain = inspect.signature(function)
        *given, rest = plain.parameters.values()
        options = [
            inspect.Parameter(
                option,
                inspect.Parameter.KEYWORD_ONLY,
                default=None,
                annotation=getattr(hint, "__forward_arg__", hint),
            )
            for option, hint in keywords.__annotations__.items()
        ]
        shown = plain.replace(parameters=[*given, *options, rest])
        function.__signature__ = shown  # type: ignore[attr-defined]
        return function

    return name
