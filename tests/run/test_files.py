"""Files of a run: each is as its own writer makes it of the run's frames, options and facts."""

import numpy as np
import pytest

import texvent
from texvent.frames import Video
from texvent.io.files import extension_of, writable_formats
from texvent.pipeline import video_to_events
from texvent.run.files import RunFiles, TruthFolder, run_with_truth, write_run
from texvent.runtime.progress import NoProgress
from texvent.settings.resolution import resolve
from texvent.view.drawing.palettes import PALETTES
from texvent.view.preview import PREVIEW_KINDS, Preview

from ..truth.hand_video import board_video

FACTS = {"prompt": "a board moves right", "note": "given by the caller"}


@pytest.mark.long
@pytest.mark.parametrize("palette", sorted(PALETTES))
def test_every_file_is_made_with_the_options_and_facts_of_the_run(tmp_path, palette):
    run = video_to_events(board_video(), resolve("simulate", {"interpolate": "exact"}))
    files = RunFiles(tmp_path / "a.h5", previews=PREVIEW_KINDS, palette=palette, truth=("flow",))
    steps = []
    write_run(run, files, metadata=FACTS, on_step=lambda *step: steps.append(step))
    packets = [packet for _, packet in steps]
    assert texvent.load(files.events).equals(texvent.EventStream.concat(packets))
    assert texvent.load(files.events).metadata == FACTS
    assert texvent.load_truth(files.truth_folder).metadata == FACTS
    options = {"size": run.video.size, "fps": run.video.fps, "kinds": PREVIEW_KINDS}
    with Preview(tmp_path / "own", palette=palette, metadata=FACTS, **options) as preview:
        for step in steps:
            preview.append(*step)
    for own, path in zip(preview.paths, files.paths[1:], strict=True):
        assert path.read_bytes() == own.read_bytes(), path
    assert sorted(files.outputs) == sorted(tmp_path.glob("a.*"))


class Dropping(Video):
    """Frames whose facts are known in part only when they have been read."""

    def __iter__(self):
        self.metadata.update(frames_dropped=0)
        for frame in super().__iter__():
            yield frame
            self.metadata.update(frames_dropped=3, ended_by="the camera")


@pytest.mark.parametrize("stated", [{}, {"frames_dropped": 0}])
def test_facts_that_only_reading_tells_are_in_every_file(tmp_path, stated):
    pixels = np.random.default_rng(1).integers(0, 255, (4, 12, 16)).astype(np.uint8)
    video = Dropping(pixels, [0, 10_000, 20_000, 30_000], metadata={"source": "camera", **stated})
    run = video_to_events(video, resolve("simulate", {"interpolate": "none"}))
    files = RunFiles(tmp_path / "a.h5", previews=("html",))
    write_run(run, files, on_step=lambda *step: None)
    source = {"source": "camera", "frames_dropped": 3, "ended_by": "the camera"}
    assert texvent.load(files.events).metadata["source"] == source
    page = files.paths[1].read_text(encoding="utf-8")
    assert all(name in page for name in source)


def test_scene_changes_are_told_while_files_are_written(tmp_path):
    image = np.random.default_rng(1).uniform(30, 110, (40, 48))
    levels = image * np.array([1, 1, 2.2, 2.2])[:, None, None]
    video = Video(levels.astype(np.uint8), [0, 10_000, 20_000, 30_000])
    run, told = video_to_events(video, resolve("simulate", {"interpolate": "blend"})), []
    write_run(
        run, RunFiles(tmp_path / "a.h5"), on_step=lambda *step: None,
        on_scene_change=lambda change, t_us: told.append((change.name, t_us)),
    )  # fmt: skip
    assert told == [("FLASH", 20_000)]


IDS = ("instance", "class_id")
HOLD_IDS = ("hdf5", "npz", "dsec")


@pytest.mark.parametrize("truth", [(), ("boxes",), ("events",)])
@pytest.mark.parametrize("name", writable_formats())
def test_a_file_holds_what_a_run_in_memory_has_as_far_as_it_has_a_place(tmp_path, name, truth):
    options = {"interpolate": "exact", "label_noise": name in HOLD_IDS}
    run, path = video_to_events(board_video(), resolve("simulate", options)), tmp_path / "a"
    files = RunFiles(path.with_suffix(extension_of(name)), format=name, truth=truth)
    write_run(run, files, on_step=lambda *step: None)
    read = texvent.load(files.events, size=run.video.size)
    kept = texvent.EventStream.concat([*run])
    if truth:
        kept = run_with_truth(run, TruthFolder(tmp_path / "b", truth), NoProgress())
    assert (kept.instance is not None) == ("events" in truth)
    for column in ("x", "y", "t", "p"):
        np.testing.assert_array_equal(getattr(read, column), getattr(kept, column))
    for column in ("label", *IDS):
        if name in HOLD_IDS:
            np.testing.assert_array_equal(getattr(read, column), getattr(kept, column))
        else:
            assert getattr(read, column) is None
    if "events" in truth:
        stored = texvent.load_truth(files.truth_folder)
        np.testing.assert_array_equal(stored.event_instance, kept.instance)
        np.testing.assert_array_equal(stored.event_class_id, kept.class_id)
