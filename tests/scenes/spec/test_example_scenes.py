"""The scene files of docs/examples/scenes: each can be staged and drawn, and shows every object."""

import tomllib
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.generate.scene_input import list_nouns, list_words
from texvent.scenes.spec.files import load_scene
from texvent.scenes.spec.schema import json_schema
from texvent.sensor import SensorSize

FILES = sorted((Path(__file__).parents[3] / "docs" / "examples" / "scenes").glob("*.toml"))
SCHEMA = json_schema(list_words(list_nouns()))
INSTANTS_US = (100_000, 1_000_000, 1_900_000)
LEAST_PIXELS = 4
"""Of an object at the instant at which it is seen best."""


def test_there_are_twenty():
    assert len(FILES) >= 20


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_object_is_in_view(path):
    scene = load_scene(path)
    jsonschema.validate(tomllib.loads(path.read_text()), SCHEMA)
    generator = ProceduralGenerator(
        ProceduralConfig(duration=2.0, samples=1), size=SensorSize(112, 84)
    )
    video = generator.generate(scene)
    most: dict[int, int] = {}
    for time_us in INSTANTS_US:
        instance = video.ground_truth(time_us, time_us + 10_000).instance
        for body, pixels in zip(*np.unique(instance, return_counts=True), strict=True):
            most[int(body)] = max(most.get(int(body), 0), int(pixels))
    hidden = [noun for body, noun in video.class_names.items() if most.get(body, 0) < LEAST_PIXELS]
    assert hidden == []
    image = video.at(INSTANTS_US[1]).pixels
    assert np.isfinite(image).all()
    assert image.std() > 10.0
    assert scene.prompt
