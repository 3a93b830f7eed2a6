"""A specification is read as it was meant, or refused in one line that names the place."""

from pathlib import Path
from typing import Any

import pytest
from tests.refusals import Call, Refusal, check_refusal

from texvent.dataset.generation.recipe import Recipe, load_recipe
from texvent.dataset.specification.items import read_items
from texvent.dataset.specification.reading import read_specification, specification_from
from texvent.errors import ConfigError, InputError

WHOLE = """
name = "cars"
seed = 7
samples-per-shard = 4
splits = { train = 0.75, test = 0.25 }

[options]
duration = 0.2
contrast-threshold = { uniform = [0.1, 0.5] }

[[sources]]
template = "a {colour} {thing}"
words.colour = ["red", "blue"]
words.thing = "things.txt"
label = "{thing}"

[[sources]]
file = "more.csv"

[variants.paper]
seeds = 2

[variants.v2e]
simulator = "v2e"

[filters]
min-events = 10
"""


def test_every_part_of_a_file_is_read(tmp_path):
    (tmp_path / "spec.toml").write_text(WHOLE)
    (tmp_path / "things.txt").write_text("car\n# a comment\ndog\n")
    (tmp_path / "more.csv").write_text("prompt,label,seed\na bus turns,bus,3\na red car,car,\n")
    spec = read_specification(tmp_path / "spec.toml")
    assert (spec.name, spec.seed, spec.samples_per_shard) == ("cars", 7, 4)
    assert spec.options == {"duration": 0.2, "contrast_threshold": {"uniform": [0.1, 0.5]}}
    assert [(one.name, one.seeds, one.options) for one in spec.variants] == [
        ("paper", 2, {}),
        ("v2e", 1, {"simulator": "v2e"}),
    ]
    assert spec.filters.min_events == 10
    items = read_items(spec)
    # "a red car" of the list equals one of the template.
    assert [item.prompt for item in items.all] == [
        "a red car",
        "a red dog",
        "a blue car",
        "a blue dog",
        "a bus turns",
    ]
    assert items.duplicates == 1
    assert items.labels == ("bus", "car", "dog")
    assert items.all[4].seed == 3


def test_a_recipe_is_the_same_after_it_was_stored(tmp_path):
    (tmp_path / "spec.toml").write_text(WHOLE)
    (tmp_path / "things.txt").write_text("car\u2028\x85that drives left\n")
    (tmp_path / "more.csv").write_text('prompt,label\n"a\u2029bus",bus\n')
    recipe = Recipe.of(read_specification(tmp_path / "spec.toml"))
    recipe.begin(tmp_path / "out")
    assert load_recipe(tmp_path / "out") == recipe


def test_videos_take_their_class_from_their_folder(tmp_path):
    for name in ("cat/a.mp4", "dog/b.mp4"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).touch()
    source = {"videos": "*/*.mp4", "label": "{folder}"}
    items = read_items(specification_from({"name": "v", "sources": [source]}, folder=tmp_path))
    assert [item.label for item in items.all] == ["cat", "dog"]
    assert items.are_videos


def test_words_are_drawn_without_repetition_and_by_the_seed():
    source = {"template": "{a} {b}", "words": {"a": list("abcdef"), "b": list("ghijkl")},
              "count": 20}  # fmt: skip

    def prompts(seed: int) -> list[str | None]:
        spec = specification_from({"name": "x", "seed": seed, "sources": [source]}, folder=Path())
        return [item.prompt for item in read_items(spec).all]

    assert len(set(prompts(0))) == 20
    assert prompts(0) == prompts(0) != prompts(1)


def test_classes_are_words_and_labels():
    source = {"classes": ["cat", "dog"], "template": "a photo of a {class}"}
    items = read_items(specification_from({"name": "x", "sources": [source]}, folder=Path()))
    assert [(item.prompt, item.label) for item in items.all] == [
        ("a photo of a cat", "cat"),
        ("a photo of a dog", "dog"),
    ]


ONE = {"name": "x", "sources": [{"prompts": ["a car"]}]}


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        ({"sources": "prompts.txt"}, "must be a list of tables"),
        ({"sources": [{"prompts": ["a"], "videos": "b"}]}, "source 1: a source has prompts and"),
        ({"sources": [{"prompts": ["a"], "count": 3}]}, "belong to a template"),
        ({"sources": [{"promts": ["a"]}]}, "source 1: unknown 'promts'; allowed: prompts, file"),
        ({"sources": [{"classes": ["a"]}]}, "classes need a template"),
        ({"splits": {"train": 0.5}}, "add up to 0.5; make it 1"),
        ({"sources": [{"prompts": ["a"], "split": "val"}]}, "for split 'val'"),
        ({"options": {"seed": 3}}, "set seed beside options"),
        ({"options": {"fps": {"unifrom": [1, 2]}}}, "range of fps"),
        ({"options": {"fps": {"uniform": [2, 1]}}}, "must be [lowest, highest]"),
        ({"variants": {"a b": {}}}, "variant is 'a b'"),
        ({"filters": {"min_events": 9, "max_events": 3}}, "max_events is 3"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(change, wanted):
    with pytest.raises(ConfigError) as caught:
        specification_from({**ONE, **change}, folder=Path())
    assert wanted in str(caught.value)
    assert str(caught.value).startswith("specification: ")
    assert len(str(caught.value)) < 300


def nest(value: Any, *names: str | int) -> Any:
    """A value below names of tables and places of lists."""
    for name in reversed(names):
        value = {name: value} if isinstance(name, str) else [value]
    return value


TABLES = [
    *([], ["splits"], ["options"], ["filters"], ["variants", "esim"], ["variants", 0]),
    *(["variants", 0, "options"], ["sources", 0], ["sources", 0, "words"], ["sources", 0, "vary"]),
]


@pytest.mark.parametrize("names", TABLES, ids=str)
@pytest.mark.parametrize("value", [5, "x", ["x"], {1: 2}], ids=str)
def test_what_is_no_table_of_names_is_refused_wherever_there_is_one(names, value):
    tables = {**ONE, **nest(value, *names)} if names else value
    with pytest.raises(ConfigError, match=r"it must be|unknown") as caught:
        specification_from(tables, folder=Path())
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("sources", "wanted"),
    [
        ([{"template": "a {thing}"}], "has no words for thing"),
        ([{"template": "a car", "words": {"thing": ["a"]}}], "does not use thing"),
        ([{"template": "a {thing", "words": {"thing": ["a"]}}], "write names to fill in as {name}"),
        ([{"template": "{a}", "words": {"a": ["x"]}, "count": 2}], "has 1 combinations"),
        ([{"template": "{a}", "words": {"a": ["x"]}, "label": "{b}"}], "names {b}"),
        ([{"file": "none.txt"}], "no such list"),
        ([{"videos": "none/*.mp4"}], "nothing matches"),
        ([{"prompts": ["a"]}, {"prompts": ["b"], "label": "c"}], "1 of 2"),
    ],
)
def test_sources_that_give_nothing_are_refused(sources, wanted):
    spec = specification_from({"name": "x", "sources": sources}, folder=Path())
    with pytest.raises(InputError, match=wanted.replace("{", "\\{").replace("}", "\\}")):
        read_items(spec)


def of(source: dict[str, Any] | None = None, **changes: Any) -> Call:
    """Reads a specification of one source or more, and its items; files count from a folder."""
    tables = {**ONE, **({"sources": [source]} if source else {}), **changes}
    return lambda folder: read_items(specification_from(tables, folder=folder))


def template(*words: Any) -> dict[str, Any]:
    return {"template": "a {b}", "words": {"b": list(words)}}


def fps(**drawn: Any) -> Call:
    return of(options={"fps": drawn})


FILES = {
    "cars.txt": "a car\n",
    "notes.md": "a car\n",
    "empty.txt": "# nothing\n\n",
    "a.npy": "",
}
VIDEO, BOXED = {"videos": "a.npy"}, {"videos": "a.npy", "boxes": "b.json"}
REFUSED: dict[str, Refusal] = {
    "boxes": (of({"prompts": ["a"], "boxes": "b.json"}), ConfigError,
              "source 1: boxes are labels of videos; this source has none", of(BOXED)),
    "box rate": (of({**VIDEO, "box_rate": 10}), ConfigError,
                 "box_rate is that of boxes; this source names", of({**BOXED, "box_rate": 10})),
    "no list": (fps(uniform=5), ConfigError, "uniform is 5; it must be a list", fps(choice=[5])),
    "logarithm": (fps(log_uniform=[0, 9]), ConfigError, "log_uniform begins at 0; give more",
                  fps(log_uniform=[0.5, 9])),
    "whole": (fps(integer=[1, 2.5]), ConfigError, "fps: integer is [1, 2.5]; whole numbers",
              fps(integer=[1.0, 2])),
    "words": (of(template(["x"])), ConfigError, "b is [['x']]; it must be a list of texts",
              of(template("x", 2, 3.5))),
    "shares": (of(splits={"a": 0.5, "b": 0.500002}), ConfigError, "add up to 1.000002; make it 1",
               of(splits={"a": 0.5, "b": 0.5000009})),
    "kinds": (of(sources=[{"prompts": ["a car"]}, VIDEO]), ConfigError, "give prompts and videos;",
              of(sources=[{"prompts": ["a car"]}, {"prompts": ["a bus"]}])),
    "other file": (of({"file": "notes.md"}), InputError, "notes.md is no list; its name must end",
                   of({"file": "cars.txt"})),
    "empty": (of({"file": "empty.txt"}), InputError, "empty.txt holds no prompt",
              of({"file": "cars.txt"})),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_lies_beside_a_mistake_is_read(name, tmp_path):
    for file, text in FILES.items():
        (tmp_path / file).write_text(text)
    check_refusal(REFUSED[name], tmp_path, tmp_path)
