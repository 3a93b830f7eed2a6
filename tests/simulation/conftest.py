"""Where the GPU backend's tests run: on a GPU, else on the CPU in Triton's interpreter."""

import importlib
import os
import re
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from texvent.runtime import threads


@cache
def sharing_modules() -> list[ModuleType]:
    """Modules that share work out among threads."""
    sources = Path(threads.__file__).parents[2]
    found = []
    for path in sources.glob("texvent/*/**/*.py"):
        if re.search(r" import .*\brun_parts\b", path.read_text("utf-8")):
            name = ".".join(path.relative_to(sources).with_suffix("").parts)
            found.append(importlib.import_module(name))
    return found


@pytest.fixture
def small_parts(monkeypatch) -> list[int]:
    """Three threads share frames of any size; numbers of parts of each piece of work so far."""
    made: list[int] = []

    def run_parts(work: Any, parts: Any) -> Any:
        made.append(len(parts))
        return threads.run_parts(work, parts)

    monkeypatch.setenv(threads.THREADS_VARIABLE, "3")
    for module in sharing_modules():
        monkeypatch.setattr(module, "run_parts", run_parts)
        monkeypatch.setattr(module, "PIXELS_PER_THREAD", 512, raising=False)
    return made


@pytest.fixture(scope="session")
def device() -> str:
    """The device of the frames; TEXVENT_REQUIRE_GPU=1 accepts nothing but a GPU."""
    torch = pytest.importorskip("torch")
    if torch.cuda.is_available():
        return "cuda"
    if os.environ.get("TEXVENT_REQUIRE_GPU") == "1":
        pytest.fail("TEXVENT_REQUIRE_GPU is 1, and torch finds no GPU")
    return "cpu"
