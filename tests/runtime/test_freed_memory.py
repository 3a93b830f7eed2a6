"""Freed memory goes back to the system when it is asked to, and not before."""

import subprocess
import sys

import pytest

from texvent.runtime.memory import _find_trim

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
