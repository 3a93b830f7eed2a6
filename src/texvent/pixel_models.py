"""The pixel models and their options, by class: for stepping through frames of your own.

from texvent.pixel_models import EsimConfig, EsimSimulator

simulator = EsimSimulator(EsimConfig(contrast_threshold_on=0.3), seed=1)
packet = simulator.step(frame)  # a texvent.Frame
"""

from texvent.simulate.esim.simulator import EsimConfig, EsimSimulator
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.physical.simulator import PhysicalSimulator
from texvent.simulate.senpi.simulator import SenpiConfig, SenpiSimulator
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.simulator import TexventSimulator
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
    "V2eConfig",
    "V2eSimulator",
    "VoltmeterConfig",
    "VoltmeterSimulator",
]
