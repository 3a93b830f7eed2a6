from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture
def folder_is_clean(tmp_path: Path) -> Callable[[], bool]:
    """True while nothing, hidden or not, lies in the test's folder."""
    return lambda: not list(tmp_path.iterdir())
