"""Every case of the simulators runs by the kernels and by their definitions."""

from collections.abc import Iterator
from contextlib import nullcontext

import pytest
from tests.simulate.references import definitions


@pytest.fixture(params=["kernels", "definition"])
def kernels(request) -> Iterator[None]:
    with definitions() if request.param == "definition" else nullcontext():
        yield
