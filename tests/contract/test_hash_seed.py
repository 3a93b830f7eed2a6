"""Hash seeds of Python, which order its sets, have no part in what is printed, read or drawn."""

import os
import subprocess
import sys

import pytest

SCRIPT = """
import hashlib, texvent
from tests.scenes.read.expected import sentences
from texvent.cli.app import main
from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
for words in (["scenes"], ["scenes", "--schema"], ["generators", "--json"]):
    main(words)
    print("=====", flush=True)
for prompt, _ in sentences():
    try: print(texvent.read(prompt))
    except texvent.InputError as error: print(error)
print("=====")
config = ProceduralConfig(duration=0.1, samples=1)
video = ProceduralGenerator(config, seed=2, size=SensorSize(48, 36)).generate(
    "two dogs chase a ball past a tree in a city at night")
for one in video: print(hashlib.sha256(one.pixels.tobytes()).hexdigest())
print(video.metadata["prompt_report"])
"""
PARTS = ("vocabulary", "schema", "models", "reading", "drawing")


@pytest.mark.long
def test_order_of_sets_changes_nothing():
    printed = []
    for seed in ("1", "3", "6"):
        run = subprocess.run(
            [sys.executable, "-c", SCRIPT],
            env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
            text=True,
        )
        printed.append(run.stdout.split("=====\n"))
    for name, *outputs in zip(PARTS, *printed, strict=True):
        assert len(set(outputs)) == 1, name
        assert len(outputs[0]) > 100, name
