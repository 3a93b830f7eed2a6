"""Samples keep their names and seeds, whatever stands beside them in the list."""

import json
import re
from contextlib import nullcontext
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.recorded_frames import DSEC_EVENTS, DSEC_IMAGES, IMAGES, TIMES
from texvent.dataset.specification.entries import are_videos, read_samples
from texvent.errors import InputError, TexventWarning


def listed(folder: Path, *prompts: str) -> Path:
    path = folder / "prompts.txt"
    path.write_text("".join(f"{prompt}\n" for prompt in prompts))
    return path


def identities(folder: Path, *prompts: str, seed: int = 0) -> list[tuple[str, str, int]]:
    samples = read_samples([listed(folder, *prompts)], seed=seed)
    return [(sample.key, sample.name, sample.seed) for sample in samples]


def test_an_inserted_line_changes_no_other_sample(tmp_path):
    before = identities(tmp_path, "a red car", "a dog")
    after = identities(tmp_path, "a cat", "a red car", "# note", "a dog")
    assert set(before) < set(after)


def test_equal_prompts_have_names_and_seeds_of_their_own(tmp_path):
    keys, names, seeds = zip(*identities(tmp_path, *["a red car"] * 20), strict=True)
    assert len(set(keys)) == len(set(names)) == len(set(seeds)) == 20
    assert all(name.startswith("a-red-car-") for name in names)


def test_another_seed_of_the_batch_gives_other_seeds_and_the_same_names(tmp_path):
    first, second = identities(tmp_path, "a dog"), identities(tmp_path, "a dog", seed=1)
    assert first[0][:2] == second[0][:2]
    assert first[0][2] != second[0][2]


@given(st.integers(0, 2**63 - 1), st.text(min_size=1, max_size=300))
def test_seeds_and_names_are_always_allowed(tmp_path_factory, seed, prompt):
    folder = tmp_path_factory.mktemp("list")
    (folder / "p.jsonl").write_text(f"{json.dumps(prompt)}\n")
    if not prompt.strip():
        return
    (sample,) = read_samples([folder / "p.jsonl"], seed=seed)
    assert 0 <= sample.seed < 2**63
    (folder / f"{sample.name}.h5").touch()


def test_a_seed_and_a_name_in_the_list_count(tmp_path):
    (tmp_path / "p.csv").write_text("prompt,name,seed\na dog,rex,7\n")
    (sample,) = read_samples([tmp_path / "p.csv"], seed=3)
    assert (sample.name, sample.seed) == ("rex", 7)
    (tmp_path / "p.csv").write_text("prompt,name,seed\na dog,rex,8\n")
    (other,) = read_samples([tmp_path / "p.csv"], seed=3)
    assert other.key != sample.key


def test_folders_and_patterns_give_their_videos(tmp_path):
    clips = tmp_path / "clips"
    clips.mkdir()
    for name in ("b.mp4", "a.AVI"):
        (clips / name).touch()
    found = read_samples([clips], seed=0)
    assert [sample.video for sample in found] == [clips / "a.AVI", clips / "b.mp4"]
    (pattern,) = read_samples([f"{clips}/*.mp4"], seed=0)
    assert pattern.video == clips / "b.mp4"
    assert pattern.key == found[1].key
    (tmp_path / "moved").mkdir()
    clips = clips.rename(tmp_path / "moved" / "clips")
    assert [sample.key for sample in read_samples([clips], seed=0)] == [one.key for one in found]
    assert are_videos([clips])
    assert not are_videos([listed(tmp_path, "a dog")])


@pytest.mark.parametrize("source", ["", "*", "**/*.mp4"])
def test_names_say_which_folder_below_the_source_a_video_is_of(tmp_path, source):
    for place in ("left", "right"):
        (tmp_path / place).mkdir()
        (tmp_path / place / "a.mp4").touch()
    found = read_samples([tmp_path / source], seed=0)
    assert [one.name for one in found] == [
        f"{place}-a-{one.key[:8]}" for place, one in zip(("left", "right"), found, strict=True)
    ]
    (left,) = read_samples([tmp_path / "left"], seed=0)
    assert left.name == f"a-{found[0].key[:8]}"


VIDEOS, STILLS = ["a.mp4", "b.NPY"], ["a.JPG", "b.png"]


@pytest.mark.parametrize("of_stills", [False, True])
@pytest.mark.parametrize("places", [[""], ["left", "right"]], ids=["together", "by class"])
def test_a_folder_gives_what_it_or_the_folders_in_it_hold(tmp_path, of_stills, places):
    samples, others = (STILLS, VIDEOS) if of_stills else (VIDEOS, [])
    for place in places:
        (tmp_path / place).mkdir(exist_ok=True)
        for name in (*samples, *others, "notes.md", f".hidden{samples[0][1:]}"):
            (tmp_path / place / name).touch()
    found = read_samples([tmp_path], seed=0, of_stills=of_stills)
    wanted = [tmp_path / place / name for place in places for name in samples]
    assert [sample.video for sample in found] == wanted
    assert len({sample.key for sample in found}) == len({one.seed for one in found}) == len(found)
    (tmp_path / "none").mkdir()
    refusal = "none holds no image, and `camera` moves" if of_stills else "none holds no video"
    with pytest.raises(InputError, match=refusal):
        read_samples([tmp_path / "none"], seed=0, of_stills=of_stills)


@pytest.mark.parametrize(
    ("sources", "why"),
    [
        ((), "there is nothing to do"),
        (("address.csv",), r"video is the address http://host/a.mp4\.\.\.; a list"),
        (("twice.csv",), r"twice\.csv line 3 and twice\.csv line 2 have one name, 'X'"),
    ],
)
def test_mistakes_are_named(tmp_path, monkeypatch, sources, why):
    monkeypatch.chdir(tmp_path)
    Path("address.csv").write_text("video\nhttp://me:secret@host/a.mp4?key=secret\n")
    Path("twice.csv").write_text("prompt,name\na car,x\na dog,X\n")
    with pytest.raises(InputError, match=why) as caught:
        read_samples(sources, seed=0)
    assert "secret" not in str(caught.value)


def test_a_recording_is_one_entry_alone_and_among_others(tmp_path):
    bag = "rosbag2_bagfile_information:\n"
    recordings: dict[str, tuple[str, ...]] = {
        "bag": ("metadata.yaml", "a.db3", "a.npy"),
        "dsec": (DSEC_EVENTS, f"{DSEC_IMAGES}/0.png", "a.npy"),
        "evreal": (IMAGES, TIMES, "events_xy.npy"),
    }
    others = {"frames": ("images/0.png", "masks/0.png", "images.txt"), "imgs": ("0.png",)}
    for name, files in {**recordings, **others}.items():
        for file in files:
            path = tmp_path / ("set" if name in recordings else "others") / name / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(bag if file == "metadata.yaml" else "")
    found = read_samples([tmp_path / "set"], seed=0)
    assert [one.video for one in found] == [tmp_path / "set" / name for name in recordings]
    for place in [*(tmp_path / "set" / name for name in recordings), tmp_path / "others/imgs"]:
        assert [one.video for one in read_samples([place], seed=0)] == [place]
    with pytest.warns(TexventWarning, match="images and folders of images"):
        (one,) = read_samples([tmp_path / "others/frames"], seed=0)
    assert one.video == tmp_path / "others/frames"


def test_a_picture_beside_the_videos_of_a_class_hides_none_and_patterns_find_each_kind(tmp_path):
    for place in ("cat/a.mp4", "cat/poster.png", "dog/b.mp4", "bird/0.png"):
        (tmp_path / place).parent.mkdir(exist_ok=True)
        (tmp_path / place).touch()
    videos = [tmp_path / "cat/a.mp4", tmp_path / "dog/b.mp4"]
    with pytest.warns(TexventWarning, match="folders of videos are taken alone") as warned:
        assert [one.video for one in read_samples([tmp_path], seed=0)] == videos
    of_videos, of_folders = re.findall(r"'([^']*)'", str(warned[0].message))
    assert [one.video for one in read_samples([of_videos], seed=0)] == videos
    with pytest.warns(TexventWarning, match="cat/? holds videos and images"):
        found = {one.video for one in read_samples([of_folders], seed=0)}
    assert found == {*videos, tmp_path / "bird"}


PLACES = (
    *("a.mp4", "b.mp4", "0.png", "images/0.png", "notes.txt", ".kept/a.mp4", "masks/notes.txt"),
    *(f"{one}/{file}" for one in ("cat", "dog") for file in ("c.mp4", "0.png", "images/0.png")),
    "cat/far/0.png",
)


@given(st.sets(st.sampled_from(PLACES), min_size=1))
def test_a_folder_of_anything_is_the_first_kind_of_frames_in_it(chosen):
    here = sorted(one for one in chosen if "/" not in one and one.endswith("mp4"))
    classes = [one for one in ("cat", "dog") if any(place.startswith(one) for place in chosen)]
    films = [f"{one}/c.mp4" for one in classes if f"{one}/c.mp4" in chosen]
    still = [one for one in classes if f"{one}/c.mp4" not in chosen]
    kinds = {
        "videos": here,
        "images": [""] if chosen & {"0.png", "images/0.png"} else [],
        "folders of videos": films,
        "folders of images": [
            one for one in still if chosen & {f"{one}/0.png", f"{one}/images/0.png"}
        ],
    }
    found = [kind for kind, places in kinds.items() if places]
    with TemporaryDirectory() as name:
        folder = Path(name)
        for place in chosen:
            (folder / place).parent.mkdir(parents=True, exist_ok=True)
            (folder / place).touch()
        if not found:
            with pytest.raises(InputError, match="holds no video, no images and no folders of"):
                read_samples([folder], seed=0)
            return
        said = rf"holds {' and '.join(found)}, of which the {found[0]} are taken alone"
        with pytest.warns(TexventWarning, match=said) if found[1:] else nullcontext():
            samples = read_samples([folder], seed=0)
    assert [one.video for one in samples] == [folder / place for place in kinds[found[0]]]
