"""The fused pass is tested with compiled kernels, unless a test wants the definitions."""

from __future__ import annotations

import pytest

from .clips import wait_for_kernels


@pytest.fixture(autouse=True, scope="session")
def compiled() -> None:
    wait_for_kernels()
