"""Samples simulated on demand are those that a data set stores."""

from pathlib import Path

import pytest

import texvent.dataset
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent_lab.train.reconstruction.simulated_clips import SimulatedClips

SPECIFICATION = """\
name = "tiny"
splits = {train = 0.5, test = 0.5}
filters = {min_events = 1}
options = {duration = 0.1, sensor = "32x24", contrast_threshold = {uniform = [0.1, 0.3]}}
[[sources]]
template = "a red {thing} drives left"
words.thing = ["car", "bus"]
[variants.paper]
seeds = 3
[variants.esim]
simulator = "esim"
"""


@pytest.mark.long
def test_they_are_equal_to_stored_ones(tmp_path: Path) -> None:
    path = tmp_path / "tiny.toml"
    path.write_text(SPECIFICATION)
    texvent.dataset.make(path, tmp_path / "tiny")
    for variant, count in (("paper", 3), ("esim", 1)):
        stored = texvent.dataset.open(tmp_path / "tiny", variant=variant, split="test")
        clips = SimulatedClips(path, split="test", variant=variant)
        assert len(stored) == len(clips) == count
        assert len({clips.simulation(number).settings.run.seed for number in range(count)}) == count
        for number in range(count):
            events = EventStream.concat([part for _, part in clips.simulation(number).steps()])
            assert events.equals(stored.events(number))


def test_wrong_choices_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "tiny.toml"
    path.write_text(SPECIFICATION)
    with pytest.raises(ConfigError, match="variants paper, esim; choose"):
        SimulatedClips(path, split="test")
    with pytest.raises(ConfigError, match="unknown split 'val'; allowed: train, test"):
        SimulatedClips(path, split="val", variant="esim")
    with pytest.raises(IndexError, match="sample 1 does not exist; there are 1"):
        SimulatedClips(path, split="test", variant="esim").simulation(1)
    path.write_text("store_videos = true\n" + SPECIFICATION)
    with pytest.raises(ConfigError, match="tiny stores its videos; make it"):
        SimulatedClips(path, split="test", variant="esim")
