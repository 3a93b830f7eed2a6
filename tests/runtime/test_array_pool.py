"""Memory: pooled, used again once nobody holds it, and given back when that is asked for."""

import copy
import gc
import pickle
import subprocess
import sys

import numpy as np
import pytest

from texvent.runtime import memory
from texvent.runtime.array_pool import MOST, ArrayPool
from texvent.runtime.memory import _find_trim

SHAPE = (40, 50)
HOLDERS = {
    "array": lambda array: array,
    "row": lambda array: array[7],
    "view of a view": lambda array: array.view(np.uint8)[3:][..., ::2],
    "buffer": memoryview,
    "transposed and cut": lambda array: array.T[5:9],
}


def address(array):
    return array.__array_interface__["data"][0]


@pytest.mark.parametrize("hold", HOLDERS.values(), ids=HOLDERS)
def test_memory_is_not_used_again_while_any_part_of_it_is_held(hold):
    pool = ArrayPool()
    array = pool.take(SHAPE, np.float32)
    array[:], place = 1.0, address(array)
    held = hold(array)
    before = np.array(held)
    del array
    for _ in range(3):
        other = pool.take(SHAPE, np.float32)
        other[:] = 2.0
        assert address(other) != place
    assert np.array_equal(np.array(held), before)
    del held
    gc.collect(1)
    others = [pool.take(SHAPE, np.float32) for _ in range(3)]
    assert place in [address(one) for one in others]


@pytest.mark.torch
@pytest.mark.parametrize(
    "hold", [lambda one: one, lambda one: one[3:, ::2], lambda one: one.detach().numpy()[1:2]]
)
def test_memory_is_not_used_again_while_a_tensor_is_held(hold):
    torch = pytest.importorskip("torch")
    pool = ArrayPool()
    array = pool.take(SHAPE, np.int32)
    array[:] = 1
    held = hold(torch.from_numpy(array))
    del array
    for _ in range(3):
        pool.take(SHAPE, np.int32)[:] = 2
    assert (held == 1).all()


def test_one_that_is_let_go_of_gives_its_memory_to_the_next_of_its_size_and_no_other():
    pool = ArrayPool()
    places = {address(pool.take(SHAPE, np.float32)) for _ in range(10)}
    assert len(places) == 1
    assert {address(pool.take((2000,), np.int32))} == places
    assert not {address(pool.take((1999,), np.int32))} & places
    assert pool.take((3, 0, 5), np.int32).shape == (3, 0, 5)


def test_as_many_are_made_as_are_held_and_few_are_kept():
    pool = ArrayPool()
    held = [pool.take(SHAPE, np.float32) for _ in range(3 * MOST)]
    assert len({address(one) for one in held}) == 3 * MOST
    kept = {address(one) for one in held[-MOST:]}
    held.clear()
    again = [pool.take(SHAPE, np.float32) for _ in range(MOST)]
    assert {address(one) for one in again} == kept


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda pool: pickle.loads(pickle.dumps(pool))])
def test_a_copy_has_memory_of_its_own(copied):
    pool = ArrayPool()
    pool.take(SHAPE, np.float32)[:] = 1.0
    other = copied(pool).take(SHAPE, np.float32)
    assert address(other) != address(pool.take(SHAPE, np.float32))
    assert len(pickle.dumps(pool)) < 200


SCRIPT = """
import sys
from texvent.runtime.memory import release_freed_memory
def resident_kib():
    with open("/proc/self/status") as status:
        return int(next(line for line in status if line.startswith("VmRSS")).split()[1])
# Small blocks with survivors between them: the heap cannot shrink by itself.
blocks = [bytearray(60_000) for _ in range(2_000)]
survivors = blocks[::100]
del blocks
before = resident_kib()
release_freed_memory()
print(before - resident_kib())
"""
FAULTS = """
import resource
import numpy as np
from texvent.runtime.memory import keep_freed_memory
keep_freed_memory()
def fill():
    blocks = [np.full(3_000_000, 1, np.uint8) for _ in range(8)]
fill()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
fill()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""
NEEDS_GLIBC = pytest.mark.skipif(_find_trim() is None, reason="only glibc can be asked to")


@NEEDS_GLIBC
def test_what_was_freed_between_survivors_is_returned():
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True, timeout=300
    )
    # 120 MB were in use, 1 % of it still is.
    assert int(done.stdout) > 50_000


@NEEDS_GLIBC
def test_arrays_use_memory_that_was_freed_before():
    done = subprocess.run(
        [sys.executable, "-c", FAULTS], capture_output=True, text=True, check=True, timeout=300
    )
    # 24 MB have 5,860 pages.
    assert int(done.stdout) < 600


@pytest.mark.parametrize("kind", ["RLIMIT_AS", "RLIMIT_DATA"])
def test_a_soft_limit_of_the_process_bounds_what_a_run_may_use(kind):
    soft = 3 << 30
    code = (
        f"import resource; _, hard = resource.getrlimit(resource.{kind})\n"
        f"resource.setrlimit(resource.{kind}, ({soft}, hard))\n"
        "from texvent.runtime.memory import SHARE, usable_bytes\n"
        f"assert usable_bytes() <= SHARE * {soft}, usable_bytes()"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("scarce", ["machine", "group", "old group", "process"])
@pytest.mark.parametrize("others", [10**12, None])
def test_the_scarcest_memory_decides(tmp_path, monkeypatch, scarce, others):
    sizes = dict.fromkeys(("machine", "group", "old group", "process"), others)
    sizes[scarce] = 10**9 + 7
    groups = [tmp_path / name for name in ("group", "old group", "not there")]
    for one in groups[:2]:
        one.write_text("max\n" if sizes[one.name] is None else f"{sizes[one.name]}\n")
    limits = [] if sizes["process"] is None else [sizes["process"]]
    monkeypatch.setattr(memory, "machine_bytes", lambda: sizes["machine"])
    monkeypatch.setattr(memory, "_process_limits", lambda: limits)
    monkeypatch.setattr(memory, "_CONTROL_GROUPS", tuple(groups))
    assert memory.usable_bytes.__wrapped__() == int(0.8 * sizes[scarce])
