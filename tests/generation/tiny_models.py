"""Build the learned generators of the tests: tiny pipelines by their folder, with small options."""

import dataclasses

import numpy as np

from texvent._registry import GENERATORS

PROMPT = "a red cat walks"
OPTIONS = {
    "fps": 16,
    "frames": 5,
    "width": 32,
    "height": 32,
    "steps": 2,
    "guidance": 3.0,
    "on_failure": "ignore",
}


def build(path, seed=3, **options):
    part = GENERATORS.load(str(path))
    config = dataclasses.replace(part.config_type(), **{**OPTIONS, **options})
    return part(config, seed=seed, size=None)


def pixels(video):
    return np.stack([frame.pixels for frame in video])
