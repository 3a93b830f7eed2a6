"""The process of a job runs commands that come through a pipe."""

import json
import subprocess
import sys

import pytest


@pytest.mark.parametrize(("commands", "runs", "code"), [("vv", 2, 0), ("vxv", 1, 2), ("x", 0, 2)])
def test_a_job_runs_its_commands_until_one_fails(commands: str, runs: int, code: int) -> None:
    words = {"v": ["scenes", "--help"], "x": ["no-command"]}
    job = [sys.executable, "-m", "texvent.cli.simulation.job"]
    with subprocess.Popen(job, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(json.dumps([words[one] for one in commands]) + "\n")
        process.stdin.flush()
        said = process.stdout.read()  # its end of the pipe stays open until the job is over
        assert (said.count("usage: "), process.wait(60)) == (runs, code)
