"""Every case of the simulators runs on every backend."""

import pytest


@pytest.fixture(params=["reference", "numpy", "cpu"])
def backend(request) -> str:
    return request.param
