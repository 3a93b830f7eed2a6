"""What every interpolating network needs to be read."""

from __future__ import annotations

from texvent.runtime.network_files import Tensor

EXTRA = "rife"
"""The texvent extra that brings torch and safetensors."""

__all__ = ["EXTRA", "Tensor"]
