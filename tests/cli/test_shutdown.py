"""The process ends soon and with a word, also while kernels are being compiled."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

COMPILE_FOR_LONG = """
import sys, threading, types
from texvent.cli import shutdown
from texvent.runtime import background_jit
module = types.ModuleType("slow_kernel")
module.warm_up = lambda: threading.Event().wait({seconds})
sys.modules["slow_kernel"] = module
background_jit.is_ready("slow_kernel")
sys.stdout.write("done")
shutdown.LOADING_S = {announced_after}
sys.exit(shutdown.end_process({code}))
"""


def start(seconds, code, announced_after=0.1):
    program = COMPILE_FOR_LONG.format(seconds=seconds, code=code, announced_after=announced_after)
    return subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.parametrize("code", [2, 130])
def test_after_an_error_or_ctrl_c_nothing_is_waited_for(code):
    process = start(600, code)
    assert process.communicate(timeout=300) == ("done", "")
    assert process.returncode == code


def test_a_good_run_says_that_it_compiles_and_ctrl_c_ends_that_without_an_error():
    process = start(600, 0)
    assert "the output is complete; compiling for later runs" in process.stderr.readline()
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=300) == ("done", "")
    assert process.returncode == 0


def test_kernels_that_are_soon_ready_are_waited_for_without_a_word():
    process = start(0, 0, announced_after=60)
    assert process.communicate(timeout=300) == ("done", "")
    assert process.returncode == 0
