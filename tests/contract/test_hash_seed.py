"""Hash seeds of Python, which order its sets, have no part in what is printed, read or drawn."""

import os
import subprocess
import sys

import pytest

READ = """
import texvent
from tests.scenes.read.expected import sentences
for prompt, _ in sentences():
    try: print(texvent.read(prompt))
    except texvent.InputError as error: print(error)
"""
DRAW = """
import hashlib
from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
config = ProceduralConfig(duration=0.1, samples=1)
video = ProceduralGenerator(config, seed=2, size=SensorSize(48, 36)).generate(
    "two dogs chase a ball past a tree in a city at night")
for one in video: print(hashlib.sha256(one.pixels.tobytes()).hexdigest())
print(video.metadata["prompt_report"])
"""
COMMANDS = {
    "vocabulary": ("-m", "texvent", "scenes"),
    "schema": ("-m", "texvent", "scenes", "--schema"),
    "models": ("-m", "texvent", "generators", "--json"),
    "reading": ("-c", READ),
    "drawing": ("-c", DRAW),
}


@pytest.mark.long
@pytest.mark.parametrize("name", COMMANDS)
def test_order_of_sets_changes_nothing(name):
    printed = {
        subprocess.run(
            [sys.executable, *COMMANDS[name]],
            env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "3", "6")
    }
    assert len(printed) == 1
    assert len(*printed) > 100
