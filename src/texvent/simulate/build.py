"""The simulator of a run, built from its options; impossible runs are refused before any work."""

from __future__ import annotations

from typing import Any, cast

from texvent._registry import SIMULATORS
from texvent.config import InterpolateConfig, RunConfig
from texvent.simulate.fused.continuous import check_continuous
from texvent.simulate.plug_in import WatchedPlugIn
from texvent.simulate.protocol import Simulator
from texvent.simulate.stepping import with_advance


def build_simulator(run: RunConfig, config: Any) -> Simulator:
    """The simulator of a run, before its first frame.

    Backend and engine are passed only where they are not the default, so that a simulator of
    another package need not know them.

    Args:
        run: its simulator, seed, backend and engine.
        config: the simulator's options.

    Raises:
        ConfigError: there is no such simulator, or it has no such backend.
        TexventError: a simulator of another package is broken; also while it runs.
    """
    options = {"backend": run.backend, "engine": run.engine}
    named = {name: value for name, value in options.items() if value not in ("auto", "frames")}
    kind = SIMULATORS.load(run.simulator)

    def build() -> Any:
        return kind(config, seed=run.seed, **named)

    if run.simulator in SIMULATORS.builtin:
        return with_advance(build())
    return cast("Simulator", WatchedPlugIn(build, run.simulator))


def check_engine(run: RunConfig, config: Any, interpolate: InterpolateConfig) -> None:
    """Refuse a run that its engine cannot do, before any work.

    Args:
        run: its simulator, backend and engine.
        config: the simulator's options.
        interpolate: how intermediate frames are made.

    Raises:
        ConfigError: the engine is continuous, and the simulator, one of its options, the backend
            or the interpolator does not fit.
    """
    if run.engine == "continuous":
        check_continuous(
            SIMULATORS.load(run.simulator),
            config,
            name=run.simulator,
            backend=run.backend,
            interpolate=interpolate.interpolate,
        )
