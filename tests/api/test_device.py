"""A device that is named beats the variable, through every door that takes one."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests.cli.running import run

import texvent
from texvent.errors import TexventError
from texvent.runtime.devices import VARIABLE

FRAMES = np.random.default_rng(0).integers(0, 255, (3, 12, 16), dtype=np.uint8)
PROMPT = "a red ball bounces in a room"
SMALL = {"sensor": "16x12", "duration": 0.1, "samples": 1}
SPECIFICATION = f"""
name = "balls"
options = {{ sensor = "16x12", duration = 0.1, samples = 1 }}
sources = [{{ prompts = ["{PROMPT}"] }}]
"""
WORDS = ("--sensor", "16x12", "--duration", "0.1", "--samples", 1, "-q")


def push(device: str) -> object:
    camera = texvent.EventCamera(size=(16, 12), device=device)
    return [camera.step(one, 10_000 * t) for t, one in enumerate(FRAMES)]


def make(device: str) -> None:
    sources = (texvent.dataset.SampleSource(prompts=(PROMPT,)),)
    made = texvent.dataset.Specification(name="balls", sources=sources, options=SMALL)
    done = texvent.dataset.make(made, f"balls-{device}", device=device, workers=1, progress=False)
    if done.failures:
        raise TexventError(str(done.failures))


def command(*words: object) -> Callable[[str], None]:
    def door(device: str) -> None:
        np.save("clip.npy", FRAMES)
        Path("prompts.txt").write_text(PROMPT)
        Path("balls.toml").write_text(SPECIFICATION)
        if run(*words, "--device", device, "-o", f"out-{device}"):
            raise TexventError

    return door


DOORS: dict[str, Callable[[str], object]] = {
    "simulate": lambda device: texvent.simulate(FRAMES, fps=50, device=device),
    "generate": lambda device: texvent.generate(PROMPT, **SMALL, device=device),
    "EventCamera": push,
    "dataset.make": make,
    "texvent simulate": command("simulate", "clip.npy", "--fps", 50, "--format", "npz", "-q"),
    "texvent generate": command("generate", PROMPT, "--format", "npz", *WORDS),
    "texvent batch": command("batch", "prompts.txt", "--format", "npz", *WORDS),
    "texvent rig": command("rig", PROMPT, *WORDS),
    "texvent dataset make": command("dataset", "make", "balls.toml", "--workers", 1, "-q"),
}


@pytest.mark.parametrize("door", DOORS)
def test_a_device_that_is_named_beats_the_variable(door, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(VARIABLE, "cuda:77")
    with pytest.raises(TexventError):
        DOORS[door]("auto")
    DOORS[door]("cpu")
