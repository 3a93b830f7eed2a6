"""Where the GPU backend's tests run: on a GPU, else on the CPU in Triton's interpreter."""

from __future__ import annotations

import os

import pytest


@pytest.fixture(scope="session")
def device() -> str:
    """The device of the frames; TEXVENT_REQUIRE_GPU=1 accepts nothing but a GPU."""
    torch = pytest.importorskip("torch")
    if torch.cuda.is_available():
        return "cuda"
    if os.environ.get("TEXVENT_REQUIRE_GPU") == "1":
        pytest.fail("TEXVENT_REQUIRE_GPU is 1, and torch finds no GPU")
    return "cpu"
