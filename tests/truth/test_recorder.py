"""A folder of truth: its content by hand, by other readers, and what is refused."""

import itertools
import json
import shutil
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import texvent
from texvent.camera import PosedCamera
from texvent.errors import ConfigError, FileFormatError, InputError, OutputError
from texvent.frames import Frame, MotionVectors, Video
from texvent.pipeline import video_to_events
from texvent.run.files import RunFiles, write_run
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.truth.class_ids import CLASS_IDS
from texvent.truth.sinks import encode_flow, write_png
from texvent.view.drawing.canvas import png_bytes

from .hand_video import SIZE, board_video, level

BOX = CLASS_IDS["box"]
SMALL = SensorSize(40, 30)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Folder, truth read back, and the events of the board."""
    folder = tmp_path_factory.mktemp("truth") / "board.truth"
    events = texvent.simulate(board_video(), interpolate="exact", noise="none", truth_folder=folder)
    return folder, texvent.load_truth(folder), events


def dsec_decode(path):
    """As DSEC's site describes it: three channels of 16 bits; the first is x, the last validity."""
    rgb = cv2.cvtColor(cv2.imread(str(path), cv2.IMREAD_UNCHANGED), cv2.COLOR_BGR2RGB)
    assert rgb.dtype == np.uint16
    return (rgb[..., :2].astype(np.float32) - 2**15) / 128.0, rgb[..., 2] == 1


@given(st.lists(st.floats(-300.0, 300.0) | st.just(np.nan), min_size=8, max_size=8))
@example([1.5, -2.25, np.nan, 0.0, 300.0, 0.0, -256.0, 255.9921875])
def test_an_independent_reader_gets_x_and_y_to_half_a_step_and_validity(values):
    flow, half = np.reshape(values, (2, 2, 2)), 0.5 / 128.0
    with TemporaryDirectory() as folder:
        write_png(Path(folder) / "f.png", encode_flow(flow))
        read, valid = dsec_decode(Path(folder) / "f.png")
    is_within = ((flow >= -256.0 - half) & (flow < 256.0 - half)).all(axis=2)
    np.testing.assert_array_equal(valid, is_within)
    np.testing.assert_allclose(read[valid], flow[valid], rtol=0.0, atol=half)


def test_pngs_of_flow_are_that_flow(written):
    folder, truth, _ = written
    assert truth.times_us.tolist() == [0, 40_000, 80_000, 120_000, 160_000, 200_000]
    for way, flow, index in (("forward", truth.flow, 1), ("backward", truth.flow_back, 2)):
        stored, valid = dsec_decode(folder / f"flow/{way}/{index:06d}.png")
        np.testing.assert_array_equal(valid, np.isfinite(flow(index)).all(axis=2))
        np.testing.assert_allclose(stored[valid], flow(index)[valid], atol=1 / 128)
        rows = np.loadtxt(folder / f"flow/{way}_timestamps.txt", delimiter=",", dtype="int64")
        times = truth.times_us.tolist()
        there = [list(pair) for pair in itertools.pairwise(times)]
        assert rows.tolist() == ([pair[::-1] for pair in there] if way == "backward" else there)


def test_other_readers_find_the_files(written):
    folder, truth, _ = written
    ids = cv2.imread(str(folder / "instance/000003.png"), cv2.IMREAD_UNCHANGED)
    assert ids.dtype == np.uint16
    np.testing.assert_array_equal(ids, truth.instance(3))
    np.testing.assert_array_equal(truth.class_id(3), np.where(ids == 3, BOX, 0))
    assert truth.classes == {BOX: "box"}
    poses = np.loadtxt(folder / "poses.txt")
    assert poses.shape == (6, 8)
    np.testing.assert_allclose(poses[:, 1:4], [[0.0, -8.0, 1.5]] * 6)
    camera = json.loads((folder / "camera.json").read_text())
    assert camera["intrinsics"] == [80.0, 80.0, 39.5, 29.5]


@pytest.mark.parametrize("turn", ["0 0 0 0", "nan 0 0 1", "0 0 90 1", "0.5 0.5 0 0"])
def test_poses_that_are_none_are_refused(written, tmp_path, turn):
    folder = shutil.copytree(written[0], tmp_path / "p.truth")
    (folder / "poses.txt").write_text(f"0 1 2 3 {turn}\n" * 6)
    with pytest.raises(FileFormatError, match="a quaternion qx qy qz qw of length 1"):
        texvent.load_truth(folder).poses  # noqa: B018


def test_coco_and_prophesee_boxes_agree_with_the_instance_map(written):
    folder, truth, _ = written
    coco = json.loads((folder / "boxes/coco.json").read_text())
    assert {"info", "images", "annotations", "categories"} == set(coco)
    assert coco["categories"] == [{"id": BOX, "name": "box", "supercategory": "object"}]
    assert [one["t_us"] for one in coco["images"]] == truth.times_us.tolist()
    assert [one["id"] for one in coco["annotations"]] == list(range(1, 7))
    records = np.load(folder / "boxes/bbox.npy")
    for index, (one, record) in enumerate(zip(coco["annotations"], records, strict=True)):
        rows, columns = np.nonzero(truth.instance(index) == 3)
        width, height = np.ptp(columns) + 1, np.ptp(rows) + 1
        assert one["image_id"] == index
        assert one["category_id"] == BOX
        assert one["bbox"] == [columns.min(), rows.min(), width, height]
        assert one["area"] == len(rows)
        assert one["iscrowd"] == 0
        assert record.tolist() == (
            truth.times_us[index], columns.min(), rows.min(), width, height, BOX, 3, 1.0
        )  # fmt: skip


def test_each_event_of_a_moving_board_is_the_boards(written):
    _, truth, events = written
    assert len(events) > 100
    assert truth.event_instance.tolist() == [3] * len(events)
    assert truth.event_class_id.tolist() == [BOX] * len(events)
    assert events.instance.tolist() == [3] * len(events)
    assert events.class_id.tolist() == [BOX] * len(events)


def test_truth_changes_no_event(written):
    _, _, events = written
    again = texvent.simulate(board_video(), interpolate="exact", noise="none")
    assert again.instance is None
    assert again.equals(events.with_ids(None, None))


def test_a_zoom_is_in_the_intrinsics(tmp_path):
    def zooming(time_s: float) -> PosedCamera:
        return replace(level(time_s), focal=1.0 + time_s)

    texvent.save_truth(board_video(zooming), tmp_path / "z.truth", "poses")
    focal = texvent.load_truth(tmp_path / "z.truth").camera_matrices[:, 0, 0]
    np.testing.assert_allclose(focal, 80.0 * (1.0 + np.arange(6) / 25.0))


@dataclass(frozen=True)
class MotionFrames:
    """A dark square, id 5, that moves 4 px to the right per frame over bright ground."""

    size: SensorSize = SMALL
    fps: Fraction = Fraction(25)
    frame_count: int = 5
    is_live: bool = False
    has_ids: bool = True
    number: int = 5

    @property
    def metadata(self):
        return {}

    def ids(self, index: int):
        ids = np.zeros(self.size.shape, np.int32)
        ids[10:20, 4 + 4 * index : 12 + 4 * index] = self.number
        return ids

    def __iter__(self):
        for index in range(self.frame_count):
            ids = self.ids(index)
            flow = np.zeros((*self.size.shape, 2), np.float32)
            flow[ids > 0, 0] = 4.0
            back = -flow
            flow[0, 0] = np.nan
            pixels = np.where(ids > 0, 40, 200).astype(np.uint8)
            depth = np.where(ids > 0, 2.0, 9.0).astype(np.float32)
            motion = MotionVectors(flow, back, depth=depth, instance=ids if self.has_ids else None)
            yield Frame(pixels, index * 40_000, motion=motion)


def test_truth_that_comes_with_frames_passes_through_unchanged(tmp_path):
    frames = MotionFrames()
    names = "flow,flow-back,depth,ids,boxes,events"
    parts = texvent.TruthFolder(tmp_path / "m.truth", names)
    events = texvent.simulate(frames, interpolate="none", noise="none", truth_folder=parts)
    truth = texvent.load_truth(tmp_path / "m.truth")
    motions = [frame.motion for frame in frames]
    np.testing.assert_array_equal(truth.instance(), [one.instance for one in motions])
    np.testing.assert_array_equal(truth.depth(), [one.depth for one in motions])
    np.testing.assert_array_equal(truth.flow(), [one.forward for one in motions[:-1]])
    np.testing.assert_array_equal(truth.flow_back(), [one.backward for one in motions[1:]])
    assert len(events)
    assert truth.event_instance.tolist() == [5] * len(events)
    assert truth.classes == {1000: "object"}
    coco = json.loads((tmp_path / "m.truth/boxes/coco.json").read_text())
    assert coco["categories"] == [{"id": 1000, "name": "object", "supercategory": "object"}]
    assert {one["category_id"] for one in coco["annotations"]} == {1000}
    with pytest.raises(InputError, match="does not say what is occluded"):
        truth.occluded(0)


def test_the_parts_of_a_folder_of_truth_are_motion_that_simulate_reads(written, tmp_path):
    folder, truth, _ = written
    parts = {
        "motion": str(folder / "flow/forward_npz"),
        "motion_back": str(folder / "flow/backward_npz"),
        "depth": str(folder / "depth"),
        "instances": str(folder / "instance"),
    }
    frames = np.stack([frame.pixels for frame in board_video()])
    texvent.simulate(
        frames,
        t_us=truth.times_us.tolist(),
        truth_folder=texvent.TruthFolder(tmp_path / "b.truth", "flow,flow-back,depth,ids,boxes"),
        **parts,
    )
    again = texvent.load_truth(tmp_path / "b.truth")
    for name in ("instance", "depth", "flow", "flow_back"):
        np.testing.assert_array_equal(getattr(again, name)(), getattr(truth, name)())
    places = ["t", "x", "y", "w", "h", "track_id"]
    np.testing.assert_array_equal(again.boxes[places], truth.boxes[places])


def test_frames_in_between_move_the_ids_along(tmp_path):
    parts = texvent.TruthFolder(tmp_path / "m.truth", "events")
    options = {"interpolate": "flow", "fixed_count": 3, "noise": "none"}
    events = texvent.simulate(MotionFrames(), truth_folder=parts, **options)
    ids = texvent.load_truth(tmp_path / "m.truth").event_instance
    swept = MotionFrames().ids(0)
    swept[10:20, 4:28] = 5
    inside = swept[events.y, events.x] == 5
    assert inside.mean() > 0.9
    assert (ids[inside] == 5).mean() > 0.95


def test_truth_that_nobody_knows_is_refused(tmp_path):
    video = Video(np.zeros((3, 30, 40), np.uint8), [0, 40_000, 80_000])
    with pytest.raises(InputError, match="truth 'flow' is not known of the frame at 0"):
        texvent.simulate(video, truth_folder=texvent.TruthFolder(tmp_path / "a.truth", "flow"))
    with pytest.raises(InputError, match="truth 'ids' is not known"):
        texvent.save_truth(MotionFrames(has_ids=False), tmp_path / "a.truth", "ids")
    with pytest.raises(ConfigError, match="truth 'poses' needs a known camera"):
        texvent.save_truth(MotionFrames(), tmp_path / "a.truth", "poses")
    with pytest.raises(ConfigError, match="frames that were stretched"):
        texvent.simulate(
            board_video(), sensor="40x20", fit="stretch", truth_folder=tmp_path / "a.truth"
        )
    with pytest.raises(
        ConfigError, match="no part 'flwo' of truth; allowed: flow, flow-back, depth"
    ):
        texvent.save_truth(board_video(), tmp_path / "a.truth", "flwo")
    for parts, words in {
        "": "parts is ''; give some of flow",
        "events": "parts is 'events'; give",
    }.items():
        with pytest.raises(ConfigError, match=words):
            texvent.save_truth(board_video(), tmp_path / "a.truth", parts)
    with pytest.raises(InputError, match="no frame was given, so there is no truth to write"):
        texvent.save_truth(MotionFrames(frame_count=0), tmp_path / "a.truth", "ids")
    with pytest.raises(InputError, match=r"ids run from 0 to 65536; files hold 0\.\.65535"):
        texvent.save_truth(MotionFrames(number=65_536), tmp_path / "a.truth", "ids")
    with pytest.raises(ConfigError, match="as_packets"):
        texvent.generate("a ball", as_packets=True, truth_folder=tmp_path / "a.truth")
    assert not list(tmp_path.iterdir())


def test_ids_have_16_bits(tmp_path):
    texvent.save_truth(MotionFrames(number=65_535), tmp_path / "a.truth", "ids")
    assert texvent.load_truth(tmp_path / "a.truth").instance().max() == 65_535


def test_a_clip_cut_in_time_keeps_its_truth(tmp_path):
    texvent.simulate(
        board_video(), interpolate="none", start=0.05, truth_folder=tmp_path / "cut.truth"
    )
    times = texvent.load_truth(tmp_path / "cut.truth").times_us
    assert times.tolist() == [80_000, 120_000, 160_000, 200_000]


def test_only_folders_of_truth_are_replaced(tmp_path):
    folder = texvent.save_truth(board_video(), tmp_path / "a.truth", "ids")
    with pytest.raises(OutputError, match="exists already"):
        texvent.save_truth(board_video(), folder, "depth")
    texvent.save_truth(board_video(), folder, "depth", overwrite=True)
    truth = texvent.load_truth(folder)
    assert truth.parts == ("depth",)
    with pytest.raises(InputError, match=r"has no flow: .* is depth; write it again with flow in"):
        truth.flow(0)
    (folder / "depth" / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match="holds other files"):
        texvent.save_truth(board_video(), folder, "depth", overwrite=True)
    assert (folder / "depth" / "notes.txt").exists()


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("truth.json", "{", "is damaged"),
        ("truth.json", None, r"a\.truth holds no truth\.json; give a folder that --truth wrote"),
        ("instance/000000.png", png_bytes(np.zeros((60, 80), np.uint8)), "0.png is no 16-bit PNG"),
        ("truth.json", "[]", "is not of the format"),
        ("truth.json", '{"format": "texvent truth 1", "frames": 6}', "width of truth.json is None"),
        ("timestamps.txt", "0\n1\n", "counts 6 frames, timestamps.txt 2"),
        ("depth/000000.npz", "PK", "NumPy archive"),
        ("depth/000000.npz", None, "no such file"),
        ("instance/000000.png", "no", "cannot be decoded"),
        ("poses.txt", "1 2 3\n", "poses.txt cannot be read"),
        ("boxes/bbox.npy", "x", "bbox.npy holds no array"),
        ("boxes/coco.json", "{}", "coco.json holds no boxes"),
    ],
)
def test_damage_is_named(written, tmp_path, name, text, message):
    folder = shutil.copytree(written[0], tmp_path / "a.truth")
    if text is None:
        (folder / name).unlink()
    else:
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(InputError, match=message):
        texvent.load_truth(folder).check(SIZE)


@dataclass(frozen=True)
class Damaged(MotionFrames):
    """Ends in an error after some frames."""

    sound: int = 3

    def __iter__(self):
        yield from itertools.islice(super().__iter__(), self.sound)
        raise InputError("the video ends in damage")


@pytest.mark.parametrize(("sound", "keeps"), [(3, True), (3, False), (0, True)])
def test_a_run_that_ends_early_keeps_what_there_is_only_if_asked(tmp_path, sound, keeps):
    run = video_to_events(Damaged(sound=sound), resolve("simulate", {"interpolate": "none"}))
    files = RunFiles(
        tmp_path / "d.h5", truth=("ids", "flow", "depth", "events"), keep_partial=keeps
    )
    if not (sound and keeps):
        with pytest.raises(InputError, match="ends in damage"):
            write_run(run, files, on_step=lambda frame, packet: None)
        assert not list(tmp_path.iterdir())
        return
    assert write_run(run, files, on_step=lambda frame, packet: None).t_us == 80_000
    truth, events = texvent.load_truth(tmp_path / "d.truth"), texvent.load(tmp_path / "d.h5")
    assert len(truth) == 3
    assert truth.metadata["complete"] is False
    assert len(events)
    np.testing.assert_array_equal(truth.event_instance, events.instance)


@pytest.mark.parametrize("run", [texvent.simulate, texvent.generate])
def test_a_folder_of_other_files_is_refused_before_the_source_is_looked_at(run, tmp_path):
    (tmp_path / "notes.txt").touch()
    with pytest.raises(OutputError, match="the folder holds other files"):
        run("a xyzzy.mp4", truth_folder=tmp_path)


def test_the_facts_of_a_folder_say_all_that_a_reader_needs(tmp_path):
    folder = texvent.save_truth(board_video(), tmp_path / "a.truth", "depth,ids")
    facts = json.loads((folder / "truth.json").read_text())
    (number,) = facts["classes"]
    assert facts == {
        "format": "texvent truth 1",
        "parts": ["depth", "ids"],
        "frames": 6,
        "width": 80,
        "height": 60,
        "time_unit": "us, on the clock of the events",
        "classes": {number: "box"},
        "instances": {"3": {"class_id": int(number), "class": "box"}},
        "run": {"source": dict(board_video().metadata)},
    }
