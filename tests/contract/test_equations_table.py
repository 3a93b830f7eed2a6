"""docs/equations.md names, for every equation, a function and a test that exist."""

import ast
import importlib
import re
import sys
import types
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from texvent._registry import GENERATORS
from texvent.frames import Video
from texvent.pipeline import text_to_events, video_to_events
from texvent.settings.resolution import resolve

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"^\| (\d)(?: \(.\))? \| `([\w.]+)` \| `([\w./]+)::(\w+)` \| .+ \|$", re.MULTILINE)
ROWS = ROW.findall((ROOT / "docs" / "equations.md").read_text(encoding="utf-8"))


def test_every_equation_has_a_row():
    assert sorted({number for number, *_ in ROWS}) == list("1234567")


@pytest.mark.parametrize("path", sorted({path for _, path, *_ in ROWS}))
def test_the_function_of_a_row_exists(path):
    module, _, name = path.rpartition(".")
    assert getattr(importlib.import_module(module), name).__doc__


@pytest.mark.parametrize(("file", "name"), sorted({tuple(row[2:]) for row in ROWS}))
def test_the_test_of_a_row_exists(file, name):
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    assert name in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


@dataclass(frozen=True, kw_only=True)
class TinyConfig:
    pass


class TinyGenerator:
    """A text-to-video model in three lines: each letter is the level of one grey frame."""

    config_type: ClassVar[type] = TinyConfig
    default_interpolate: ClassVar[str] = "blend"

    def __init__(self, config, *, seed, size):
        self.size = size

    def generate(self, prompt: str, *, progress=None) -> Video:
        levels = np.frombuffer(prompt.encode(), np.uint8)
        shape = (len(levels), *self.size.shape, 3)
        pixels = np.broadcast_to(levels[:, None, None, None], shape).copy()
        return Video(pixels, [k * 40_000 for k in range(len(levels))], fps=Fraction(25))


@pytest.fixture
def tiny_generator(monkeypatch) -> str:
    module = types.ModuleType("tiny_generator")
    module.TinyGenerator = TinyGenerator
    monkeypatch.setitem(sys.modules, "tiny_generator", module)
    monkeypatch.setitem(GENERATORS.builtin, "tiny", "tiny_generator:TinyGenerator")
    return "tiny"


def tiny_settings(generator: str):
    return resolve("generate", {"generator": generator, "sensor": "4x3", "noise": "none"})


def test_eq2_a_prompt_becomes_the_events_of_its_video(tiny_generator):
    settings = tiny_settings(tiny_generator)
    events = text_to_events("AzA", settings).packets.collect()
    video = TinyGenerator(None, seed=0, size=settings.size).generate("AzA")
    assert events.equals(video_to_events(video, settings).packets.collect())
    assert set(events.p[events.t < 40_000].tolist()) == {1}
    assert set(events.p[events.t >= 40_000].tolist()) == {0}


def test_eq3_any_generator_turns_the_prompt_into_frames(tiny_generator):
    settings = tiny_settings(tiny_generator)
    frames = list(text_to_events("az", settings).video)
    assert [frame.pixels.shape for frame in frames] == [(3, 4, 3)] * 2
    assert [int(frame.pixels[0, 0, 0]) for frame in frames] == [ord("a"), ord("z")]
