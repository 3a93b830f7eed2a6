"""The simulator of a run, built from its options; impossible runs are refused before any work."""

from __future__ import annotations

from typing import Any

from texvent._registry import SIMULATORS
from texvent.config import RunConfig
from texvent.simulate.protocol import Simulator
from texvent.simulate.stepping import with_advance


def gains_from_frames(simulator: Simulator) -> bool:
    """Whether a simulator says that more frames than Eq. 4's make its events better."""
    return bool(getattr(simulator, "gains_from_frames", False))


def build_simulator(run: RunConfig, config: Any) -> Simulator:
    """The simulator of a run, before its first frame.

    The backend is passed only where it is not the default, so that a simulator of another package
    need not know it.

    Args:
        run: its simulator, seed and backend.
        config: the simulator's options.

    Raises:
        ConfigError: there is no such simulator, or it has no such backend.
        TexventError: a simulator of another package cannot be loaded.
    """
    named = {} if run.backend == "auto" else {"backend": run.backend}
    return with_advance(SIMULATORS.load(run.simulator)(config, seed=run.seed, **named))
