"""torch, which only an extra of texvent installs."""

from __future__ import annotations

from types import ModuleType
from typing import Any, TypeAlias

from texvent._require import require

EXTRA = "rife"
"""The texvent extra that installs torch and safetensors."""
Tensor: TypeAlias = Any
"""torch.Tensor."""


def import_torch() -> ModuleType:
    """The module torch.

    Raises:
        MissingDependencyError: it is not installed.
    """
    return require("torch", extra=EXTRA)
