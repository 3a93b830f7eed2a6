"""Scenes of a data set: files, fields that vary by lists and ranges, labels of fields."""

from pathlib import Path
from typing import Any

import pytest

from texvent.dataset.generation.make import make
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.items import Items, read_items
from texvent.dataset.specification.reading import read_specification, specification_from
from texvent.dataset.statistics import in_several_splits
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.stored.stored_samples import open as open_samples
from texvent.errors import ConfigError, InputError

CAR = """prompt = "a {objects[0].colour} car"
[[objects]]
noun = "car"
motions = [{ kind = "drive", direction = "left" }]
"""
COLOUR, SPEED = "objects[0].colour", "objects[0].motions[0].speed_m_s"
BOTH = {COLOUR: ["red", "blue"], SPEED: {"uniform": [2.0, 12.0]}}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "car.toml").write_text(CAR)
    (tmp_path / "scenes" / "ball.toml").write_text('[[objects]]\nnoun = "ball"\n')
    return tmp_path


def items_of(folder: Path, seed: int = 0, **source: Any) -> Items:
    tables = {"name": "cars", "seed": seed, "sources": [source]}
    return read_items(specification_from(tables, folder=folder))


def test_files_are_scenes_with_labels_of_their_fields(folder):
    items = items_of(folder, scene="scenes/*.toml", label="{name}: {objects[0].noun}")
    assert [one.label for one in items.all] == ["ball: ball", "car: car"]
    assert items.all[1].subject.objects[0].motions[0].direction == "left"
    assert items_of(folder, scene=["scenes/car.toml"]).all[0].label is None


def test_each_file_draws_its_own_order_of_values(folder):
    sizes = {"objects[0].size": [round(1.0 + 0.5 * one, 1) for one in range(20)]}
    orders = set()
    for name in "abc":
        (folder / "scenes" / f"{name}.toml").write_text('[[objects]]\nnoun = "ball"\n')
        drawn = items_of(folder, scene=f"scenes/{name}.toml", count=9, vary=sizes).all
        orders.add(tuple(one.subject.objects[0].size for one in drawn))
    assert len(orders) == 3


def test_lists_are_combined_and_ranges_are_drawn(folder):
    every = items_of(folder, scene="scenes/car.toml", vary=BOTH, label=f"{{{COLOUR}}}").all
    assert [one.label for one in every] == ["red", "blue"]
    assert [one.prompt for one in every] == ["a red car", "a blue car"]
    speeds = [one.subject.objects[0].motions[0].speed_m_s for one in every]
    assert speeds[0] != speeds[1]
    assert all(2.0 <= speed < 12.0 for speed in speeds)
    drawn = items_of(folder, scene="scenes/car.toml", vary=BOTH, count=6).all
    assert sorted(one.prompt for one in drawn) == ["a blue car"] * 3 + ["a red car"] * 3
    again = items_of(folder, scene="scenes/car.toml", vary=BOTH, count=6).all
    other = items_of(folder, seed=1, scene="scenes/car.toml", vary=BOTH, count=6).all
    assert drawn == again
    assert {one.key for one in drawn}.isdisjoint(one.key for one in other)


def test_the_example_of_the_repository_is_read():
    path = Path(__file__).parents[3] / "configs" / "scenes" / "night-drives.toml"
    items = read_items(read_specification(path))
    assert len(items.all) == 200
    assert items.labels == ("bus", "car", "motorcycle", "truck", "van")
    assert all("{" not in one.prompt for one in items.all)


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ({"vary": {"objects[0].color": ["red"]}}, "car.toml: objects[0] has no field 'color'; "),
        ({"vary": {"objects[2].colour": ["red"]}}, "objects[2].colour is not there: objects has 1"),
        ({"vary": {COLOUR: ["rde"]}}, "car.toml: objects[0].colour is 'rde'; did you mean 'red'?"),
        ({"vary": {COLOUR: "red"}}, "objects[0].colour is 'red'; it must be a list of values, or "),
        ({"vary": {COLOUR: []}}, "objects[0].colour is []; it must be a list of values, or "),
        ({"vary": {SPEED: {"from": 1}}}, f"range of {SPEED}: {{'from': 1}}; allowed: uniform, "),
        ({"vary": {SPEED: {"uniform": [2000.0, 3000.0]}}}, "speed_m_s is "),
        ({"vary": {COLOUR: ["red"]}, "count": 2}, "vary has 1 combinations of values, fewer than "),
        ({"count": 2}, "count to a scene that varies"),
        ({"label": "{objects[0].motions}"}, "names objects[0].motions, which has no value to wri"),
        ({"label": "{objects[0].nown}"}, "objects[0] has no field 'nown'; "),
        ({"scene": "scenes/*.json"}, "nothing matches "),
        ({"scene": "scenes/bus.toml"}, "cannot read scene file "),
    ],
)
def test_a_wrong_source_is_one_line_before_any_work(folder, source, message):
    with pytest.raises((ConfigError, InputError)) as caught:
        items_of(folder, **{"scene": "scenes/car.toml", **source})
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_vary_needs_a_scene(folder):
    with pytest.raises(ConfigError, match="vary belongs to a scene"):
        items_of(folder, prompts=["a car"], vary=BOTH)


def test_every_clip_stores_its_scene(folder):
    source = {"scene": "scenes/car.toml", "vary": BOTH, "label": f"{{{COLOUR}}}"}
    options = {"duration": 0.1, "sensor": "48x36"}
    tables = {"name": "cars", "sources": [source], "options": options,
              "filters": {"min_events": 0}}  # fmt: skip
    specification = specification_from(tables, folder=folder)
    make(specification, folder / "out", workers=1)
    samples = list(open_samples(folder / "out"))
    assert len(samples) == 2
    for sample in samples:
        scene = sample.facts["scene"]
        assert scene["objects"][0]["colour"] == sample.label
        assert sample.caption == f"a {sample.label} car"
    recipe = Recipe.of(specification)
    assert {one.scene["objects"][0]["colour"] for one in recipe.items.all} == {"red", "blue"}


@pytest.mark.long
def test_scenes_with_one_prompt_may_lie_in_several_splits(folder):
    (folder / "scenes" / "ball.toml").write_text('prompt = "a ball"\n[[objects]]\nnoun = "ball"\n')
    source = {"scene": "scenes/ball.toml", "vary": {COLOUR: ["red", "blue", "green", "white"]}}
    tables = {"name": "balls", "sources": [source], "splits": {"train": 0.5, "test": 0.5},
              "options": {"duration": 0.1, "sensor": "48x36"}}  # fmt: skip
    make(specification_from(tables, folder=folder), folder / "out", workers=1)
    assert in_several_splits(StoredDataset.open(folder / "out").shards()) == set()


def test_wrong_words_are_found_before_any_work(folder):
    source = {
        "scene": "scenes/car.toml",
        "vary": {COLOUR: ["red"], "objects[0].noun": ["car", "cra"]},
    }
    specification = specification_from({"name": "cars", "sources": [source]}, folder=folder)
    with pytest.raises(InputError, match=r"objects\[0\].noun is 'cra'; did you mean 'crab'"):
        make(specification, folder / "out", workers=1)
    assert not (folder / "out").exists()
