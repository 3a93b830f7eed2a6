"""The pixel models and their options, by class: for stepping through frames of your own.

from texvent.pixel_models import EsimConfig, EsimSimulator

simulator = EsimSimulator(EsimConfig(contrast_threshold_on=0.3), seed=1)
packet = simulator.step(frame)  # a texvent.Frame
"""

from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator
from texvent.simulation.senpi.config import SenpiConfig
from texvent.simulation.senpi.simulator import SenpiSimulator
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.simulator import TexventSimulator
from texvent.simulation.v2e.config import V2eConfig
from texvent.simulation.v2e.simulator import V2eSimulator
from texvent.simulation.voltmeter.config import VoltmeterConfig
from texvent.simulation.voltmeter.simulator import VoltmeterSimulator

__all__ = [
    "EsimConfig",
    "EsimSimulator",
    "PhysicalConfig",
    "PhysicalSimulator",
    "SenpiConfig",
    "SenpiSimulator",
    "TexventConfig",
    "TexventSimulator",
    "V2eConfig",
    "V2eSimulator",
    "VoltmeterConfig",
    "VoltmeterSimulator",
]
