"""Sources of training clips: prompts and data sets bring truth at the times of frames."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.dataset.conftest import make_set

from texvent.errors import ConfigError, InputError
from texvent.frames import Video
from texvent.sensor import SensorSize
from texvent.training.clip_store import ClipStore
from texvent.training.sources import TRUTH, Clip, PromptClips, VideoClips, find_source, read_clip

SIZE = SensorSize(16, 12)
MOST = 10**9


@pytest.fixture(scope="module", params=["prompts", "data set"])
def source(request, tmp_path_factory):
    """The same kind of scene in both kinds of sources that know their truth."""
    if request.param == "prompts":
        return PromptClips(["a red car drives left", "a red ball falls"], sensor="32x24",
                           duration=0.1, seed=3)  # fmt: skip
    folder = make_set(tmp_path_factory.mktemp("set") / "cars", truth=list(TRUTH),
                      variants={}, splits={"train": 1.0},
                      sources=[{"prompts": ["a red car drives left", "a red bus drives left"]}],
                      options={"duration": 0.1, "sensor": "32x24"})  # fmt: skip
    return find_source(folder, SIZE)


def test_truth_is_of_the_frames(source):
    assert tuple(source.known_truth) == TRUTH
    assert len(source) >= 2
    clip = source.read(0, TRUTH, MOST)
    count = len(clip.times_us)
    assert clip.frames.shape == (count, 24, 32)
    assert clip.frames.dtype == np.uint8
    assert np.ptp(clip.frames) > 50
    assert clip.truth["flow"].shape == (count - 1, 2, 24, 32)
    assert clip.truth["depth"].shape == (count, 24, 32)
    assert set(clip.truth["boxes"]["t"]) <= set(clip.times_us)
    assert len(clip.truth["boxes"])
    # What moves by the flow looks alike there.
    flow = clip.truth["flow"][0]
    assert np.nanmax(np.abs(flow)) > 0.5


def test_reading_again_gives_the_same_and_a_bound_gives_the_beginning(source):
    whole, again = (source.read(1, ("depth",), MOST) for _ in range(2))
    assert np.array_equal(whole.frames, again.frames)
    part = source.read(1, ("depth",), 2 * 24 * 32)
    assert np.array_equal(part.frames, whole.frames[: len(part.frames)])
    assert len(part.truth["depth"]) == len(part.frames) == 2


def test_clips_come_back_from_disk_with_their_truth(source):
    size = source.read(0, TRUTH, MOST).nbytes
    store = ClipStore(source, TRUTH, size, 4 * size)
    first = store.get(0)
    store.get(1)
    again = store.get(0)
    assert isinstance(again.frames, np.memmap)
    assert np.array_equal(again.frames, first.frames)
    assert np.array_equal(again.truth["boxes"], first.truth["boxes"])


def test_lists_of_prompts_are_rendered_at_the_size_of_the_crops(tmp_path):
    names = tmp_path / "prompts.txt"
    names.write_text("a red car drives left\na red ball falls\n")
    found = find_source(str(names), SIZE)
    assert isinstance(found, PromptClips)
    assert len(found) == 2
    assert "a red car" in found.name(0)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PromptClips("a red ball"), "a list, even of one"),
        (lambda: PromptClips(["a red ball"], sensr="8x8"), "sensr"),
        (lambda: VideoClips(["a.mp4"], fps=-2), "fps is -2"),
        (lambda: find_source({"a"}, SIZE), "got set"),
    ],
)
def test_sources_that_cannot_be_are_refused(make, message):
    with pytest.raises(ConfigError, match=message):
        make()


def test_an_empty_folder_is_refused(tmp_path):
    with pytest.raises(InputError, match="holds no video"):
        find_source(tmp_path, SIZE)


@pytest.mark.parametrize(
    ("frames", "times_us", "message"),
    [
        (np.zeros((3, 4, 5), np.float32), [0, 1, 2], r"are float32 \[3, 4, 5\]; .* uint8 luma"),
        (np.zeros((4, 5), np.uint8), [0, 1, 2, 3], r"are uint8 \[4, 5\]"),
        (np.zeros((0, 4, 5), np.uint8), [], r"are uint8 \[0, 4, 5\]"),
        (np.zeros((3, 4, 5), np.uint8), [0, 1], "must rise, one per frame"),
        (np.zeros((3, 4, 5), np.uint8), [0, 2, 2], "must rise, one per frame"),
    ],
)
def test_a_clip_of_a_users_source_that_kernels_cannot_take_is_refused(frames, times_us, message):
    with pytest.raises(InputError, match=message):
        Clip(frames, np.array(times_us, np.int64))


@pytest.mark.parametrize("transfer", ["gamma", "linear"])
def test_levels_are_rounded_and_light_is_coded(transfer):
    light = np.random.default_rng(4).uniform(-5, 300, (3, 12, 16)).astype(np.float32).clip(0)
    video = Video(light, (0, 10, 20), metadata={"transfer": transfer})
    shares = light.astype(np.float64).clip(0, 255) / 255
    coded = 255 * shares ** (1 if transfer == "gamma" else 1 / 2.2)
    found = read_clip(video, (), MOST, None).frames
    assert np.abs(found - coded).max() <= 0.5 + 1e-4


def test_each_prompt_has_the_seed_after_that_of_the_one_before():
    options = {"sensor": "32x24", "duration": 0.1}
    both = PromptClips(["a red car drives left", "a red ball falls"], seed=3, **options)
    alone = PromptClips(["a red ball falls"], seed=4, **options)
    assert np.array_equal(both.read(1, (), MOST).frames, alone.read(0, (), MOST).frames)


class Counted:
    """Clips of one frame each, and how often each was read."""

    known_truth = ()

    def __init__(self):
        self.seen = []

    def __len__(self):
        return 6

    def name(self, index):
        return f"clip {index}"

    def read(self, index, truth, most_bytes):
        self.seen.append(index)
        return Clip(np.full((1, 8, 8), index, np.uint8), np.zeros(1, np.int64))


@example(asked=[0, 1, 2, 0, 3, 0, 1], room=1, shelf=2)
@given(
    asked=st.lists(st.integers(0, 6), max_size=40), room=st.integers(1, 4), shelf=st.integers(0, 3)
)
def test_clips_that_were_used_last_are_held_then_stored(asked, room, shelf):
    source = Counted()
    store, held, stored, expected = ClipStore(source, (), room * 72, shelf * 72), [], [], []
    for index in asked:
        assert store.get(index).frames[0, 0, 0] == index
        if index in stored:
            stored.append(stored.pop(stored.index(index)))
            continue
        expected += [] if index in held else [index]
        held = [*(one for one in held if one != index), index]
        stored = [*stored, *held[:-room]][-shelf:] if shelf else []
        held = held[-room:]
        assert (store.memory_bytes, store.disk_bytes) == (72 * len(held), 72 * len(stored))
    assert source.seen == expected
