import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.dataset.specification.clips import Clips, ClipSettings, video_seed
from texvent.dataset.specification.items import read_items
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.specification.specification import draw_options, extreme_options
from texvent.errors import ConfigError
from texvent.settings.resolution import resolve


def clips_of(prompts: list[str], **changes: object) -> Clips:
    tables = {"name": "x", "sources": [{"prompts": prompts}], **changes}
    specification = specification_from(tables, folder=Path())
    return Clips(specification, read_items(specification))


SHARES = [{"train": 1.0}, {"train": 0.8, "test": 0.2}, {"a": 0.7, "b": 0.15, "c": 0.15},
          {"a": 0.5, "none": 0.0, "b": 0.5}]  # fmt: skip


@given(
    sizes=st.lists(st.integers(1, 20), min_size=1, max_size=6).filter(lambda one: sum(one) > 9),
    repeats=st.integers(1, 3),
    splits=st.sampled_from(SHARES),
    seed=st.integers(0, 5),
)
def test_splits_have_their_share_of_every_class_and_every_clip_is_there_once(
    sizes: list[int], repeats: int, splits: dict[str, float], seed: int
) -> None:
    sources = [
        {"prompts": [f"car {label} {number}" for number in range(size)], "label": str(label)}
        for label, size in enumerate(sizes)
    ]
    clips = clips_of([], sources=sources, repeats=repeats, splits=splits, seed=seed)
    counts, of_classes = clips.counts, clips.class_counts
    assert {split: of.total() for split, of in of_classes.items()} == counts
    for split, share in splits.items():
        assert abs(counts[split] / repeats - share * sum(sizes)) < len(splits)
        for label, size in enumerate(sizes):
            assert abs(of_classes[split][str(label)] / repeats - share * size) < 1
    labels = {str(label) for label in range(len(sizes))}
    lacking = {
        split: sorted(labels - of_classes[split].keys()) for split in splits if splits[split]
    }
    assert clips.lacking() == {split: lacks for split, lacks in lacking.items() if lacks}
    all_clips = [clips.clip(split, n) for split in counts for n in range(counts[split])]
    of_item = {clip.item.key: clip.split for clip in all_clips}
    assert all(of_item[clip.item.key] == clip.split for clip in all_clips)
    for unique in (len({clip.key for clip in all_clips}), len({clip.seed for clip in all_clips})):
        assert unique == sum(sizes) * repeats == len(all_clips)


@given(root=st.integers(0, 9), own=st.none() | st.integers(0, 9))
def test_repeats_differ_and_the_first_has_the_seed_of_its_list(root: int, own: int | None) -> None:
    seeds = [video_seed(root, "a", own, repeat) for repeat in range(4)]
    assert len({*seeds}) == 4
    assert own in (None, seeds[0])
    assert seeds[1:] == [video_seed(root, "a", None, repeat) for repeat in (1, 2, 3)]


def test_a_prompt_that_is_added_changes_no_clip_of_the_others() -> None:
    prompts = [f"car {number}" for number in range(10)]
    before, after = clips_of(prompts), clips_of(["a dog", *prompts])
    seeds = {clip.key: clip.seed for clip in (after.clip("train", n) for n in range(11))}
    assert all(
        seeds[clip.key] == clip.seed for clip in (before.clip("train", n) for n in range(10))
    )


def test_a_split_that_would_be_empty_is_refused() -> None:
    with pytest.raises(ConfigError, match="split test would be empty"):
        clips_of(["a", "b"], splits={"train": 0.9, "test": 0.1})


def test_under_a_camera_the_images_of_a_folder_are_items(tmp_path: Path) -> None:
    for name in ("cats/a.png", "cats/b.png", "dogs/c.png"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    folders = [str(tmp_path / name) for name in ("cats", "dogs")]
    tables = {
        "name": "x",
        "sources": [{"videos": folders, "label": "{folder}"}],
        "options": {"camera": "shake"},
    }
    items = read_items(specification_from(tables, folder=Path()))
    assert [item.label for item in items.all] == ["cats", "cats", "dogs"]
    assert items.labels == ("cats", "dogs")


@pytest.mark.parametrize("labelled", [0, 1, 3, 4])
def test_either_all_items_have_a_label_or_none_and_their_number_is_told(labelled: int) -> None:
    sources = [{"prompts": [f"car {n}"], **({"label": "a"} if n < labelled else {})}
               for n in range(4)]  # fmt: skip
    specification = specification_from({"name": "x", "sources": sources}, folder=Path())
    if labelled in (0, 4):
        assert len(read_items(specification).all) == 4
        return
    with pytest.raises(ConfigError, match=f"{labelled} of 4 prompts or videos have a label"):
        read_items(specification)


@given(
    low=st.floats(1e-3, 1e3),
    width=st.floats(0, 1e3),
    kind=st.sampled_from(["uniform", "log_uniform"]),
    key=st.integers(),
)
def test_a_drawn_value_lies_in_its_range(low: float, width: float, kind: str, key: int) -> None:
    (value,) = draw_options({"fps": {kind: [low, low + width]}}, key).values()
    assert low * (1 - 1e-12) <= value <= (low + width) * (1 + 1e-12)


def test_draws_fill_their_range_evenly_and_do_not_depend_on_each_other() -> None:
    options = {"a": {"uniform": [0.0, 1.0]}, "b": {"uniform": [0.0, 1.0]}}
    drawn = [draw_options(options, number) for number in range(2000)]
    a, b = [one["a"] for one in drawn], [one["b"] for one in drawn]
    # Standard errors: mean .0065, correlation .022.
    assert abs(sum(a) / 2000 - 0.5) < 0.03
    mean = sum(x * y for x, y in zip(a, b, strict=True)) / 2000
    assert abs(mean - 0.25) < 0.03
    assert [draw_options({"a": options["a"]}, number)["a"] for number in range(5)] == a[:5]


def test_whole_numbers_and_choices_reach_every_value() -> None:
    options = {"n": {"integer": [1, 3]}, "c": {"choice": ["x", "y"]}}
    drawn = [draw_options(options, number) for number in range(200)]
    assert {one["n"] for one in drawn} == {1, 2, 3}
    assert {one["c"] for one in drawn} == {"x", "y"}


def test_log_uniform_has_its_median_at_the_geometric_mean() -> None:
    drawn = [draw_options({"a": {"log_uniform": [0.01, 1.0]}}, key)["a"] for key in range(2000)]
    below = sum(value < math.sqrt(0.01) for value in drawn)
    assert below == pytest.approx(1000, abs=100)


def test_every_end_of_a_range_is_among_the_extremes() -> None:
    options = {"a": {"uniform": [1, 2]}, "b": {"choice": ["x", "y", "z"]}, "c": 3}
    assert extreme_options(options) == [
        {"a": 1, "b": "x", "c": 3},
        {"a": 2, "b": "x", "c": 3},
        {"a": 1, "b": "y", "c": 3},
        {"a": 1, "b": "z", "c": 3},
    ]


@pytest.mark.parametrize("threshold", [0.1, {"choice": [0.1]}, {"uniform": [0.1, 0.3]}])
def test_settings_of_a_clip_are_those_of_its_options_with_its_seed(threshold: object) -> None:
    options = {"duration": 0.1, "contrast_threshold": threshold}
    clips = clips_of(["a car", "a dog"], options=options, seed=3)
    settings = ClipSettings("generate", options, 3)
    for number in range(2):
        clip = clips.clip("train", number)
        drawn = draw_options(options, 3, clip.key)
        assert settings.of(clip) == resolve("generate", {**drawn, "seed": clip.seed})


def test_items_that_differ_in_one_field_have_keys_of_their_own(tmp_path):
    for name in "ab":
        np.save(tmp_path / f"{name}.npy", np.zeros((2, 16, 16), np.uint8))
        (tmp_path / f"{name}.txt").write_text("1,1,3,3,4,4,1,1,1\n")
    (tmp_path / "p.jsonl").write_text('{"prompt": "a car", "seed": 7}\n')
    prompts = {"prompts": ["a car"]}
    videos = {"videos": ["a.npy"]}
    boxed = {**videos, "boxes": "a.txt", "box_rate": 10}
    every = [
        (prompts, [{"prompts": ["a bus"]}, {**prompts, "label": "car"}, {"file": "p.jsonl"}]),
        (videos, [{"videos": ["b.npy"]}, {**videos, "label": "car"}, boxed]),
        (boxed, [{**boxed, "boxes": "b.txt"}, {**boxed, "box_rate": 20}, {**boxed, "label": "x"}]),
    ]
    for one, others in every:
        keys = [
            read_items(specification_from({"name": "x", "sources": [source]}, folder=tmp_path))
            .all[0]
            .key
            for source in (one, *others)
        ]
        assert len({*keys}) == 1 + len(others), one
