"""Pages and sheets show what is in the set, whatever stands in its captions."""

import html
import inspect
import re

import cv2
import numpy as np
import pytest
from tests.dataset.conftest import CARS
from tests.dataset.stored.written_set import random_events, write_shard

from texvent.cli.app import main
from texvent.cli.dataset.stored import SampleOptions
from texvent.dataset import SampleSource, Specification, make
from texvent.dataset.preview import choose_samples, write_sample_page
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import InputError


def test_the_page_shows_every_sample_with_its_caption(cars, tmp_path, capsys):
    out = tmp_path / "look.html"
    assert main(["dataset", "sample", str(cars), "-o", str(out), "-n", "100"]) == 0
    assert "9 samples of cars" in capsys.readouterr().out
    page = out.read_text("utf-8")
    tags = re.findall(r"<([a-z]\w*)", page)
    assert tags.count("img") == tags.count("pre") == 9
    assert not {"script", "i", "link", "iframe"} & set(tags)
    for prompt in CARS["sources"][0]["prompts"]:
        assert html.escape(prompt) in page
    assert main(["dataset", "sample", str(cars), "-o", str(out)]) == 3
    assert [path.name for path in tmp_path.iterdir()] == ["look.html"]


def test_videos_without_a_caption_have_their_names(tmp_path):
    (tmp_path / "left" / "a<b>").mkdir(parents=True)
    for number, image in enumerate(np.random.default_rng(0).integers(0, 255, (4, 12, 16))):
        cv2.imwrite(str(tmp_path / "left" / "a<b>" / f"{number}.png"), image)
    sources = (SampleSource(videos=(str(tmp_path / "left"),)),)
    options = {"fps": 24, "interpolate": "none"}
    own = Specification(name="own", sources=sources, options=options)
    make(own, tmp_path / "own", progress=False)
    assert main(["dataset", "sample", str(tmp_path / "own")]) == 0
    page = (tmp_path / "own" / "samples.html").read_text("utf-8")
    assert "<strong>left/a&lt;b&gt;</strong>" in page


@pytest.mark.parametrize("words", ["Zoës Fähre", "東京の車", "машина", "سيارة", "🚗"])
def test_words_of_any_script_stand_on_the_page_as_they_are(tmp_path, words):
    path = write_shard(tmp_path, "paper", "train", 0, {"a": random_events(1)}, labels=(words,))
    dataset = StoredDataset.open(path.parent.parent)
    page = write_sample_page(dataset, choose_samples(dataset), tmp_path / "a.html", overwrite=False)
    # As the caption, its alternative, the label, and prompt and label among the facts.
    assert page.read_text("utf-8").count(words) == 5


def test_samples_are_chosen_by_chance_and_the_same_every_time(cars):
    made = StoredDataset.open(cars)

    def keys(**choice: object) -> list[str]:
        return [record.key for _, record in choose_samples(made, **choice)]  # type: ignore[arg-type]

    assert keys(count=4) == keys(count=4)
    assert len({tuple(keys(count=4, seed=seed)) for seed in range(8)}) > 3
    everything = [sample.key for shard in made.shards() for sample in shard.samples]
    assert keys(count=100) == everything
    drawn = [key for seed in range(300) for key in keys(count=3, seed=seed)]
    counts = [drawn.count(key) for key in everything]
    assert min(counts) > 60  # 100 each on average, by chance
    assert max(counts) < 140
    assert len(keys(label="bus", variant="paper")) == 2
    with pytest.raises(InputError, match="holds no samples with split 'val'"):
        keys(split="val")


def test_samples_are_chosen_by_the_commands_defaults():
    choice = inspect.signature(choose_samples).parameters.values()
    defaults = {one.name: one.default for one in choice if one.default is not one.empty}
    assert defaults == {name: getattr(SampleOptions, name) for name in defaults}
