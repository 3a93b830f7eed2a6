"""Functions of GPU kernels give the bits of those of the CPU, on every branch of them."""

import itertools
from typing import Any

import numpy as np
import pytest

from texvent.simulation.kernels import elementary
from texvent.simulation.physical import crossing_time

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
triton = pytest.importorskip("triton")

import triton.language as tl  # noqa: E402

from texvent.simulation.gpu import elementary_triton  # noqa: E402
from texvent.simulation.physical.gpu import crossing_triton  # noqa: E402

natural_log, exponential = elementary_triton.natural_log, elementary_triton.exponential
decay_and_gain, find_crossings = elementary_triton.decay_and_gain, crossing_triton.find_crossings


@triton.jit
def _elementary(given: Any, found: Any, COUNT: tl.constexpr) -> None:
    lanes = tl.arange(0, COUNT)
    x = tl.load(given + lanes)
    decay, gain = decay_and_gain(tl.abs(x))
    tl.store(found + lanes, natural_log(tl.abs(x)))
    tl.store(found + COUNT + lanes, exponential(x))
    tl.store(found + 2 * COUNT + lanes, decay)
    tl.store(found + 3 * COUNT + lanes, gain)


@triton.jit
def _crossings(given: Any, found: Any, COUNT: tl.constexpr) -> None:
    at = given + tl.arange(0, COUNT)
    line = tl.load(at), tl.load(at + COUNT), tl.load(at + 2 * COUNT)
    rest = tl.load(at + 3 * COUNT), tl.load(at + 4 * COUNT), tl.load(at + 5 * COUNT)
    curve = (line[0], line[1], line[2], rest[0], rest[1], rest[2])
    wait, rises = find_crossings(curve, tl.load(at + 6 * COUNT), tl.load(at + 7 * COUNT))
    tl.store(found + tl.arange(0, COUNT), wait)
    tl.store(found + COUNT + tl.arange(0, COUNT), rises.to(tl.float64))


def results(kernel: Any, rows: np.ndarray[Any, Any], count: int, device: str) -> Any:
    """[count, lanes] of a kernel, of rows of numbers for each lane; lanes are a power of 2."""
    given = torch.from_numpy(np.ascontiguousarray(rows, np.float64)).to(device)
    found = torch.zeros((count, given.shape[-1]), dtype=torch.float64, device=device)
    with np.errstate(all="ignore"):
        kernel[(1,)](given, found, given.shape[-1])
    return found.cpu().numpy()


def test_elementary_functions_are_those_of_the_cpu(device):
    rng = np.random.default_rng(3)
    ends = [1e-300, 0.5, np.sqrt(0.5), np.nextafter(np.sqrt(0.5), 0), 1.0, -1.0, 700.0, -800.0]
    x = np.concatenate([ends, rng.choice([-1, 1], 1016) * 10 ** rng.uniform(-12, 3, 1016)])
    expected = (
        elementary.natural_log(abs(x)), elementary.exponential(x),
        *elementary.decay_and_gain(abs(x)),
    )  # fmt: skip
    assert np.array_equal(results(_elementary, x, 4, device), expected)


def test_crossings_are_those_of_the_cpu(device):
    values = (
        (-0.25, -0.19, 0.0, 0.1, 0.25),
        (0.0, 1e-9, 1e-6, -3e-5, 2e-4, -1e-2),
        (0.0, 1e-8, -1e-3, 0.05, -0.3, 1.7),
        (1e-6, 1e-4, 3e-3, 0.05),
        (1.0, 700.0, 41_667.0, 1e6),
        (0.05, 0.2, 0.6),
    )
    every = np.array([*itertools.product(*values)])
    curves = np.random.default_rng(4).permutation(every)[:4096]
    change, slope, transient, cutoff, duration, on = curves.T
    kept = elementary.exponential(-cutoff * duration)
    given = np.stack([change, slope, transient, cutoff, duration, kept, on, on[::-1]])
    rows = np.empty((crossing_time.ROWS, len(curves)))
    rows[: len(given)] = given
    with np.errstate(all="ignore"):
        crossing_time.find_crossings(
            rows, np.empty_like(rows), np.empty(len(curves), np.int64), len(curves)
        )
    wait, rises = results(_crossings, given, 2, device)
    expected = rows[[crossing_time.WAIT, crossing_time.RISES]]
    assert np.array_equal(wait, expected[0])
    is_met = np.isfinite(wait)
    assert np.array_equal(rises[is_met], expected[1][is_met])
    assert all(100 < count < 4000 for count in (is_met.sum(), (wait == 0).sum(), rises.sum()))
