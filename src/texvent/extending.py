"""Public helpers for packages that extend texvent: tables of parts, optional packages, versions."""

from texvent._registry import (
    INTERPOLATORS,
    METRICS,
    REPRESENTATIONS,
    SIMULATORS,
    Registry,
    suggest,
)
from texvent._require import require
from texvent._version import full_version, source_commit

__all__ = [
    "INTERPOLATORS",
    "METRICS",
    "REPRESENTATIONS",
    "SIMULATORS",
    "Registry",
    "full_version",
    "require",
    "source_commit",
    "suggest",
]
