"""The kernels compile to machine code for an H100 or H200, no GPU needed, and fit its registers."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.torch
pytest.importorskip("triton")

SCRIPT = Path(__file__).with_name("compile_for_hopper.py")
MOST_REGISTERS = 168
"""Three programs of 128 threads share a multiprocessor's 65,536 registers."""


def test_every_kernel_compiles_for_hopper_without_spilling_registers(tmp_path):
    environment = os.environ | {"TRITON_INTERPRET": "0", "TRITON_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, SCRIPT], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    usage = json.loads(done.stdout)
    kernels = {name.split(",")[0] for name in usage}
    assert kernels == {
        "draw_arrivals",
        "draw_noise",
        "find_extremes",
        "stamp_crossings",
        "timestamp_events",
        "unpack_events",
        "scan_brightness",
        "scan_circuit",
        "scan_clips",
        "scan_levels",
        "scan_ramp",
    }
    for name, used in usage.items():
        assert 0 < used["REG"] <= MOST_REGISTERS, (name, used)
        assert used["LOCAL"] == 0, (name, used)
        # A division in float64 may call a routine, which keeps 8 bytes.
        assert used["STACK"] <= 8, (name, used)
