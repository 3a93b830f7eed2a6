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


CHANGES = {
    "an option of the scene": ('sensor = "32x24"', 'sensor = "32x32"'),
    "the drawn range": ("[0.1, 0.3]", "[0.1, 0.4]"),
    "the words": ('["car", "bus"]', '["van", "bus"]'),
    "the sentence": ("drives left", "drives right"),
    "the seed": ('name = "tiny"', 'name = "tiny"\nseed = 1'),
    "an option of the variant": ("seeds = 3", "seeds = 3\nbalance = 7.5"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_every_sample_has_an_identity_of_its_own_by_all_that_decides_it(tmp_path, change):
    seen = []
    for text in (SPECIFICATION, SPECIFICATION.replace(*CHANGES[change]), SPECIFICATION):
        (tmp_path / "tiny.toml").write_text(text)
        clips = [SimulatedClips(tmp_path / "tiny.toml", split=split, variant="paper")
                 for split in ("train", "test")]  # fmt: skip
        facts = [(one, number, fact) for one in clips for number in range(3) for fact in (1, 2)]
        seen.append([one.identity(number, fact) for one, number, fact in facts])
    first, second, again = seen
    assert len({*first}) == 12
    assert first == again
    assert sum(one == two for one, two in zip(first, second, strict=True)) <= 6


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
