"""Which engine a run uses, and which simulators each engine can run."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from texvent._registry import load_object
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.interpolate.densify import OnCut, Pair, dense_frames
from texvent.settings import Settings
from texvent.simulate.look_ahead import step_through
from texvent.simulate.protocol import Simulator
from texvent.video import Frame

FUSED: Mapping[str, str] = {
    "texvent": "texvent.simulate.texvent.fused:FusedTexvent",
    "esim": "texvent.simulate.fused.line_pixels:FusedEsim",
}
"""Simulator → the same model on candidates; see `fused.FusedPixels`."""
CONTINUOUS: Mapping[str, str] = {
    "texvent": "texvent.engine.continuous_pixels:ContinuousTexvent",
    "esim": "texvent.engine.continuous_pixels:ContinuousEsim",
}
"""Simulator → the same model in continuous time; see `continuous.LinePixelModel`."""
WITH_PATHS = ("flow", "blend", "none")
"""Interpolators whose frames are `Paths`, or that make none."""


def check_engine(settings: Settings) -> None:
    """Refuse a run that its engine cannot do; nothing is computed.

    Raises:
        ConfigError: the engine is continuous, and the simulator, one of its options or the
            interpolator does not fit.
    """
    if settings.run.engine != "continuous":
        return
    simulator, interpolate = settings.run.simulator, settings.interpolate.interpolate
    if settings.run.backend == "gpu":
        raise ConfigError("engine 'continuous' has no backend gpu; use engine 'frames'")
    if simulator not in CONTINUOUS:
        raise ConfigError(
            f"engine 'continuous' cannot run simulator {simulator!r}; it runs esim, and texvent "
            "with multi_event, reset 'step' and stamp 'linear': choose one, or engine 'frames'"
        )
    if interpolate not in WITH_PATHS:
        raise ConfigError(
            f"engine 'continuous' cannot follow interpolate {interpolate!r}; it follows "
            f"{', '.join(WITH_PATHS)}: choose one, or engine 'frames'"
        )
    misfit = _misfit(settings.simulate)
    if misfit is not None:
        raise ConfigError(f"engine 'continuous' runs {simulator} {misfit}; or use engine 'frames'")


def advance(
    pairs: Iterable[Pair], simulator: Simulator, settings: Settings, on_cut: OnCut | None = None
) -> Iterator[tuple[Frame, EventStream]]:
    """Frames with the packet of events that ends at each, by the engine of the run.

    Args:
        pairs: source frames, and what lies between them.
        simulator: the pixel model; the readable path steps it, the others have one of their own.
        settings: of the run.
        on_cut: told of every jump.

    Yields:
        Every dense frame (engine "frames"), or every source frame (engine "continuous").
    """
    check_engine(settings)
    if settings.run.engine == "continuous":
        name, models = "texvent.engine.continuous:step_continuously", CONTINUOUS
    elif is_fusable(settings):
        name, models = "texvent.engine.fused:step_fused", FUSED
    else:
        return step_through(simulator, dense_frames(pairs, on_cut))
    pixels = load_object(models[settings.run.simulator])(settings.simulate, settings.run.seed)
    steps: Iterator[tuple[Frame, EventStream]] = load_object(name)(pairs, pixels, on_cut)
    return steps


def is_fusable(settings: Settings) -> bool:
    """Whether `fused.step_fused` can run it, sooner; the events are the same either way.

    Pictures that nothing moves in (`blend`, `none`) are drawn sooner than done without.
    """
    return (
        settings.run.simulator in FUSED
        and settings.run.backend in ("auto", "cpu")
        and settings.interpolate.interpolate == "flow"
        and getattr(settings.simulate, "noise", "none") != "gaussian"
        and getattr(settings.simulate, "threshold_sigma", 0.0) == 0.0
        and importlib.util.find_spec("numba") is not None
    )


def _misfit(config: Any) -> str | None:
    """What a model's options must be, if they are not."""
    if getattr(config, "threshold_sigma", 0.0) > 0:
        return "with threshold_sigma 0 only, so that all pixels have one threshold"
    wanted = {"multi_event": True, "reset": "step", "stamp": "linear"}
    if any(getattr(config, name, value) != value for name, value in wanted.items()):
        return "with multi_event, reset 'step' and stamp 'linear' only (preset accurate)"
    if getattr(config, "cache", "local") == "none":
        return "with cache local, leaky or global: 'none' forgets at every frame"
    if getattr(config, "noise", "none") == "gaussian":
        return "with noise adaptive, random or none: 'gaussian' shakes every frame"
    return None
