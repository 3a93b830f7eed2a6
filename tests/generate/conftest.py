"""Makes the stand-in for NVIDIA's guardrail importable before any test imports diffusers."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "stand_ins"))
