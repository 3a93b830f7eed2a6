"""Devices: what auto stands for, what it does where a GPU cannot be used, and lack of memory."""

import ctypes

import pytest

from texvent.errors import ConfigError, InputError, TexventWarning
from texvent.runtime import devices

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")


def test_auto_is_what_the_variable_says(monkeypatch):
    monkeypatch.setenv(devices.VARIABLE, "cuda:99")
    with pytest.raises(ConfigError, match="device is 'cuda:99'"):
        devices.find_gpu("auto")
    monkeypatch.setenv(devices.VARIABLE, "gpu")
    with pytest.raises(ConfigError, match=r"\$TEXVENT_DEVICE is 'gpu'; it must be auto, cpu, cuda"):
        devices.find_gpu("auto")
    monkeypatch.setenv(devices.VARIABLE, "cpu")
    assert devices.find_gpu("auto") is None


@pytest.mark.parametrize(
    ("capability", "message"),
    [
        (RuntimeError("CUDA error: all CUDA-capable devices are busy"), "not used: .* are busy"),
        ((6, 1), None),
    ],
)
def test_auto_takes_the_cpu_where_a_gpu_cannot_be_used(capability, message, monkeypatch):
    def find(device=None):
        if isinstance(capability, Exception):
            raise capability
        return capability

    monkeypatch.delenv(devices.VARIABLE, raising=False)
    monkeypatch.setattr(ctypes, "CDLL", lambda name: None)
    monkeypatch.setattr(torch.cuda, "is_available", lambda: True)
    monkeypatch.setattr(torch.cuda, "get_device_capability", find)
    devices._any_gpu.cache_clear()
    try:
        if message is None:
            assert devices.find_gpu("auto") is None
        else:
            with pytest.warns(TexventWarning, match=message):
                assert devices.find_gpu("auto") is None
    finally:
        devices._any_gpu.cache_clear()


@pytest.mark.parametrize(
    ("fault", "error", "message"),
    [
        (
            torch.OutOfMemoryError("CUDA out of memory. Tried to allocate 20.00 MiB."),
            InputError,
            r"8x6 .*cpu: 20\.00 MiB more were wanted; choose a smaller",
        ),
        (RuntimeError("CUDA error: an illegal memory access"), RuntimeError, "illegal"),
    ],
)
def test_only_lack_of_memory_is_called_that(fault, error, message):
    with (
        pytest.raises(error, match=message),
        devices.explain_device_memory(torch.device("cpu"), "8x6"),
    ):
        raise fault
