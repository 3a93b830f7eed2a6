"""The pixel models and their options, by class: for stepping through frames of your own.

    from texvent.pixel_models import EsimConfig, EsimSimulator

    simulator = EsimSimulator(EsimConfig(contrast_threshold_on=0.3), seed=1)
    packet = simulator.step(frame)  # a texvent.Frame

Each model is imported when it is first named.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from texvent._registry import SIMULATORS

if TYPE_CHECKING:
    from texvent.simulate.esim.simulator import EsimConfig, EsimSimulator
    from texvent.simulate.physical.config import PhysicalConfig
    from texvent.simulate.physical.simulator import PhysicalSimulator
    from texvent.simulate.senpi.simulator import SenpiConfig, SenpiSimulator
    from texvent.simulate.texvent.config import TexventConfig
    from texvent.simulate.texvent.simulator import TexventSimulator
    from texvent.simulate.v2ce.simulator import V2ceConfig, V2ceSimulator
    from texvent.simulate.v2e.simulator import V2eConfig, V2eSimulator
    from texvent.simulate.voltmeter.simulator import VoltmeterConfig, VoltmeterSimulator

__all__ = [
    "EsimConfig",
    "EsimSimulator",
    "PhysicalConfig",
    "PhysicalSimulator",
    "SenpiConfig",
    "SenpiSimulator",
    "TexventConfig",
    "TexventSimulator",
    "V2ceConfig",
    "V2ceSimulator",
    "V2eConfig",
    "V2eSimulator",
    "VoltmeterConfig",
    "VoltmeterSimulator",
]


def __getattr__(name: str) -> Any:
    """Import a class on first use (PEP 562)."""
    if name not in __all__:
        raise AttributeError(f"module 'texvent.pixel_models' has no attribute {name!r}")
    is_config = name.endswith("Config")
    model = SIMULATORS.load(name.removesuffix("Config").removesuffix("Simulator").lower())
    value = model.config_type if is_config else model
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
