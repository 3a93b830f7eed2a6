"""Public helpers for packages that extend texvent: tables of parts, optional packages, versions."""

from texvent._registry import (
    INTERPOLATORS,
    METRICS,
    REPRESENTATIONS,
    SIMULATORS,
    Registry,
    load_object,
    suggest,
)
from texvent._require import install_command, require
from texvent._version import full_version, source_commit

__all__ = [
    "INTERPOLATORS",
    "METRICS",
    "REPRESENTATIONS",
    "SIMULATORS",
    "Registry",
    "full_version",
    "install_command",
    "load_object",
    "require",
    "source_commit",
    "suggest",
]
