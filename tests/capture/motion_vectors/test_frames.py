import zipfile
from fractions import Fraction

import cv2
import numpy as np
import pytest
from tests.capture.motion_vectors import moving_scene as scene
from tests.video_check.made_clips import encode

import texvent
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, FileFormatError, InputError, TexventWarning
from texvent.frames import Frame, MotionVectors, Video
from texvent.sensor import SensorSize

FILM = scene.stack(scene.frame)
FORWARD, BACKWARD = scene.stack(scene.forward), scene.stack(scene.backward)
DEPTH, INSTANCES = scene.stack(scene.depth), scene.stack(scene.instances)


def opened(motion=None, size=None, film=FILM, **options):
    config = CaptureConfig(fps=Fraction(25), **options)
    return open_frames(film, config, size=size, motion=motion)


def check_exact(stream, forward=True, backward=True):
    motions = [frame.motion for frame in stream]
    for index, motion in enumerate(motions):
        is_first, is_last = index == 0, index == len(motions) - 1
        assert (motion.forward is None) == (is_last or not forward)
        assert (motion.backward is None) == (is_first or not backward)
        if motion.forward is not None:
            np.testing.assert_allclose(motion.forward, FORWARD[index], rtol=0, atol=0.01)
        if motion.backward is not None:
            np.testing.assert_allclose(motion.backward, BACKWARD[index], rtol=0, atol=0.01)
    return motions


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_arrays_of_one_field_per_frame(dtype):
    given = {
        "motion": FORWARD, "motion_back": BACKWARD, "depth": DEPTH, "instances": INSTANCES,
    }  # fmt: skip
    motions = check_exact(opened({name: field.astype(dtype) for name, field in given.items()}))
    assert np.array_equal(motions[2].depth, DEPTH[2].astype(dtype).astype(np.float32))
    assert np.array_equal(motions[2].instance, INSTANCES[2])
    assert (motions[2].depth.dtype, motions[2].instance.dtype) == (np.float32, np.int32)


def test_one_direction_is_enough():
    check_exact(opened({"motion": FORWARD}), backward=False)
    check_exact(opened({"motion": BACKWARD}, motion_convention="backward"), forward=False)
    check_exact(opened({"motion_back": BACKWARD}), forward=False)


@pytest.mark.parametrize("name", ["npy", "npz"])
def test_folders_with_a_file_per_frame(tmp_path, name):
    for index, flow in enumerate(FORWARD):
        if name == "npy":
            np.save(tmp_path / f"flow{index}.npy", flow)
        else:
            np.savez(tmp_path / f"f{index}.npz", forward=flow, backward=BACKWARD[index])
    config = CaptureConfig(fps=Fraction(25), motion=tmp_path)
    stream = open_frames(FILM, config)
    check_exact(stream, backward=name == "npz")


def test_one_file_for_all_frames(tmp_path):
    np.save(tmp_path / "flow.npy", FORWARD)
    np.savez(tmp_path / "all.npz", flow=FORWARD, flow_back=BACKWARD, depth=DEPTH, ids=INSTANCES)
    for name, has_backward in (("flow.npy", False), ("all.npz", True)):
        config = CaptureConfig(fps=Fraction(25), motion=tmp_path / name)
        motions = check_exact(open_frames(FILM, config), backward=has_backward)
        assert (motions[0].depth is not None) == (name == "all.npz")
    np.savez(tmp_path / "pairs.npz", flow=FORWARD[:-1], depth=DEPTH[:-1])
    motions = check_exact(opened({"motion": tmp_path / "pairs.npz"}), backward=False)
    assert [one.depth is None for one in motions] == [False] * 5 + [True]


def test_a_pattern_names_files_among_others(tmp_path):
    for index, flow in enumerate(BACKWARD):
        np.save(tmp_path / f"motion_vectors_{index:04}.npy", flow)
        np.save(tmp_path / f"distance_to_image_plane_{index:04}.npy", DEPTH[index])
    config = CaptureConfig(
        fps=Fraction(25),
        motion=tmp_path / "motion_vectors_*.npy",
        depth=tmp_path / "distance_*.npy",
        motion_convention="isaac",
    )
    motions = check_exact(open_frames(FILM, config), forward=False)
    assert np.array_equal(motions[1].depth, DEPTH[1])


@pytest.mark.parametrize(
    ("flow", "option"),
    [
        (-FORWARD, "(from|backward)"),
        (FORWARD * np.float32([1, -1]), "y-up"),
        (FORWARD / 2, "scale=2"),
        (FORWARD * 2, "scale=0.5"),
        (FORWARD * np.float32([-1, 1]), "(from|backward),y-up"),
        (FORWARD / np.float32([scene.WIDTH / 2, scene.HEIGHT / 2]), "ndc"),
    ],
)
def test_vectors_of_another_convention_are_refused_with_the_option_to_give(flow, option):
    told = rf"differ by \d+\.\d grey levels, and by [0-3]\.\d .*motion_convention={option}; give"
    with pytest.raises(InputError, match=told):
        opened({"motion": flow})
    option = option.replace("(from|backward)", "from")
    check_exact(opened({"motion": flow}, motion_convention=option), backward=False)
    list(opened({"motion": flow}, check_motion=False))


def changed(field, value, share=None):
    """A copy whose first pixel has another value, or this share of all pixels of every frame."""
    field = field.copy()
    count = 1 if share is None else int(share * scene.WIDTH * scene.HEIGHT)
    field.reshape(len(field), scene.WIDTH * scene.HEIGHT, -1)[:, :count] = value
    return field


WIDE = INSTANCES.astype(np.int64)
REFUSED_ARRAYS = {
    "too few": ({"motion": FORWARD[:-2]}, {"motion": FORWARD[:-1]},
        r"motion has fields of 4 frames, and there are 6 frames; give 6: .*, or 5: one per pair"),
    "depth per pair": ({"motion": FORWARD, "depth": DEPTH[:-1]}, {"motion": FORWARD},
        r"depth has fields of 5 frames, and there are 6 frames; give 6: one per frame$"),
    "a row too few": ({"motion": FORWARD[:, :-1]}, {"motion": FORWARD[:, ::2, ::2] / 2},
        r"motion, frame \d: the forward field is 64x47, the frames are 64x48"),
    "unknown": ({"motion": changed(FORWARD, np.nan, 0.51)},
        {"motion": changed(FORWARD, np.nan, 0.5)}, r"NaN in 51% of its pixels; at most 50%"),
    "too long": ({"motion": changed(FORWARD, -1.001e6)}, {"motion": changed(FORWARD, -1e6)},
        r"has 1 infinite vector\(s\), or of more than 1e\+06"),
    "components first": ({"motion": FORWARD.transpose(0, 3, 1, 2)}, {},
        r"components come last: \.transpose"),
    "five components": ({"motion": FORWARD[..., [0, 1, 0, 1, 0]]},
        {"motion": FORWARD[..., [0, 1, 0, 1]]},
        r"float32 of shape \[48, 64, 5\]; vectors are numbers \[H, W, 2\]$"),
    "no field": ({"motion": {"flow": FORWARD}}, {}, r"is no field of motion; give a path"),
    "twice": ({"motion": BACKWARD, "motion_back": BACKWARD, "motion_convention": "backward"}, {},
        r"backward vectors are given twice, by motion \(vectors\) and motion_back \(backward\)"),
    "exchanged": ({"motion": BACKWARD, "motion_back": FORWARD},
        {"motion": FORWARD, "motion_back": BACKWARD, "check_motion": True},
        r"forward motion vectors do not fit .* if the vectors are meant backward; exchange the"),
    "negative depth": ({"motion": FORWARD, "depth": changed(DEPTH, -1e-6)},
        {"motion": FORWARD, "depth": changed(DEPTH, 0.0)},
        r"depth, frame 0: depth has 1 value\(s\) that are NaN or negative"),
    "depth in steps": ({"motion": FORWARD, "depth": DEPTH.astype(np.uint16)},
        {"motion": FORWARD, "depth": DEPTH.astype(np.uint16), "depth_scale": 1.0},
        r"give `depth_scale`: metres per"),
    "two depths": ({"motion": FORWARD, "depth": DEPTH[..., None].repeat(2, -1)},
        {"motion": FORWARD, "depth": DEPTH[..., None]},
        r"depth has float32 of shape \[48, 64, 2\]; it is \[H, W\]"),
    "depth of another size": ({"motion": FORWARD, "depth": DEPTH[:, :, :-1]},
        {"motion": FORWARD, "depth": DEPTH[:, ::4, ::4]},
        r"depth is 63x48, the frames are 64x48"),
    "half an id": ({"motion": FORWARD, "instances": DEPTH + 0.5},
        {"motion": FORWARD, "instances": DEPTH}, r"no whole numbers"),
    **{
        f"id {bad}": ({"motion": FORWARD, "instances": changed(WIDE, bad)},
            {"motion": FORWARD, "instances": changed(WIDE, good)}, "ids of more than 32 bits")
        for bad, good in ((2**32, 2**32 - 1), (-(2**31) - 1, -(2**31)))
    },
}  # fmt: skip
"""Name → what is given, what is just good enough, words of the message."""
OPTIONS = ("motion_convention", "depth_scale", "check_motion")


def read_all(given, **options):
    options |= {name: given[name] for name in OPTIONS if name in given}
    return list(opened({name: given[name] for name in given if name not in OPTIONS}, **options))


@pytest.mark.parametrize("name", REFUSED_ARRAYS)
def test_bad_fields_are_one_clear_line(name):
    given, near, message = REFUSED_ARRAYS[name]
    with pytest.raises(InputError, match=message) as error:
        read_all(given)
    assert "\n" not in str(error.value)
    assert len(read_all(near, check_motion=False)) == len(FILM)


def test_frames_that_are_counted_late_or_once_are_refused_too(tmp_path):
    encode(FILM.astype(np.uint8), tmp_path / "film.avi", codec="ffv1")
    config = CaptureConfig(check_motion=False)
    short = open_frames(tmp_path / "film.avi", config, motion={"motion": FORWARD[:4]})
    with pytest.raises(InputError, match=r"fields of 4 frames, but there is a frame 4; give one"):
        list(short)
    pairs = open_frames(tmp_path / "film.avi", config, motion={"motion": FORWARD[:5]})
    assert [frame.motion.forward is None for frame in pairs] == [False] * 5 + [True]
    with pytest.raises(InputError, match="frames that can be read twice, not a live stream"):
        open_frames(iter(FILM), CaptureConfig(fps=Fraction(25)), motion={"motion": FORWARD})


def test_vectors_of_another_film_are_warned_of():
    noise = np.random.default_rng(3).integers(0, 256, FILM.shape).astype(np.float32)
    told = r"motion: forward motion vectors explain little: .* differ by \d+\.\d grey levels, and"
    with pytest.warns(TexventWarning, match=told):
        opened({"motion": FORWARD + np.float32(4)}, film=noise)


def write_odd_archive(path):
    np.savez(path, flow=FORWARD)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("depth", "no array")


REFUSED_FILES = {
    "missing": (lambda path: None, "no file or folder"),
    "both": (lambda path: (path.mkdir(), np.save(path / "a.npy", FORWARD[0]),
        cv2.imwrite(str(path / "a.png"), FILM[0].astype(np.uint8))),
        r"holds \.npy and \.png files; name those"),
    "empty": (lambda path: path.mkdir(), r"vectors, depth or ids; looked for \.exr, \.npz, \.npy"),
    "a.txt": (lambda path: path.write_text("1"), "is no file of motion vectors, depth or ids; kn"),
    "one.png": (lambda path: cv2.imwrite(str(path), FILM[0].astype(np.uint8)),
        "is the field of one frame"),
    "odd.npz": (lambda path: np.savez(path, u=FORWARD, v=FORWARD),
        "holds u, v; arrays must be called flow"),
    "uneven.npz": (lambda path: np.savez(path, flow=FORWARD, depth=DEPTH[:-1]),
        r"fields of different numbers of frames \(vectors 6, depth 5\)"),
    "depth.npz": (lambda path: np.savez(path, depth=DEPTH, ids=INSTANCES),
        r"depth\.npz has no motion; it holds depth, instances"),
    "number.npy": (lambda path: np.save(path, np.float32(3)), r"holds a single number; fields are"),
    "text.npz": (write_odd_archive, "is damaged: it holds entries that are no arrays"),
    "late": (lambda path: (path.mkdir(), *(
        np.savez(path / f"{index}.npz", flow=flow, **({"depth": DEPTH[0]} if index < 3 else {}))
        for index, flow in enumerate(FORWARD))),
        "the fields of frame 3 lack depth, which those of the first frame have"),
}  # fmt: skip
"""Name → how the file or folder is written, words of the message."""


@pytest.mark.parametrize("name", REFUSED_FILES)
def test_files_without_vectors_are_one_clear_line(tmp_path, name):
    write, message = REFUSED_FILES[name]
    write(tmp_path / name)
    with pytest.raises(InputError, match=message) as error:
        list(opened({"motion": tmp_path / name}))
    assert "\n" not in str(error.value)


def test_start_stop_and_fit_change_motion_as_pixels():
    given = {"motion": FORWARD, "depth": DEPTH, "instances": INSTANCES}
    stream = opened(given, SensorSize(32, 24), start=0.08, stop=0.2)
    frames = list(stream)
    assert [frame.t_us for frame in frames] == [80_000, 120_000, 160_000]
    for frame, index in zip(frames, (2, 3, 4), strict=True):
        inside = frame.motion.instance == 7
        assert np.array_equal(inside, scene.is_square(index)[1::2, 1::2])
        assert frame.motion.forward[inside] == pytest.approx(
            np.tile(np.float32(scene.SQUARE_PX) / 2, (inside.sum(), 1))
        )
        assert set(frame.motion.depth[inside]) == {scene.NEAR_M}


def test_simulate_takes_arrays_and_files(tmp_path):
    np.save(tmp_path / "flow.npy", FORWARD)
    np.save(tmp_path / "depth.npy", DEPTH)
    options = {"fps": 25, "noise": "none", "contrast_threshold": 0.15}
    events = texvent.simulate(FILM, motion=FORWARD, depth=DEPTH, **options)
    assert len(events)
    assert events.metadata["source"]["motion"] == {"motion": "motion", "depth": "depth"}
    assert events.metadata["settings"]["interpolate"]["interpolate"] == "motion"
    by_file = texvent.simulate(
        FILM, motion=tmp_path / "flow.npy", depth=str(tmp_path / "depth.npy"), **options
    )
    assert np.array_equal(events.t, by_file.t)
    assert by_file.metadata["settings"]["capture"]["motion"] == str(tmp_path / "flow.npy")
    assert len(by_file.metadata["source"]["motion_fingerprint"].split("-")) == 2
    with pytest.raises(ConfigError, match="motion_convention has 'blendr'"):
        texvent.simulate(FILM, motion=FORWARD, motion_convention="blendr", **options)


def test_following_the_vectors_is_the_default_unless_told_otherwise(tmp_path):
    (tmp_path / "run.toml").write_text('interpolate = "blend"\n')
    options = {"fps": 25, "stop": 0.12, "simulator": "esim"}

    def interpolation(**more):
        packets = texvent.simulate(FILM, as_packets=True, **options, **more)  # nothing runs
        return packets.metadata["settings"]["interpolate"]["interpolate"]

    assert interpolation() == "flow"
    assert interpolation(motion=FORWARD) == "motion"
    assert interpolation(motion_back=BACKWARD) == "motion"
    assert interpolation(depth=DEPTH) == "flow"
    assert interpolation(motion=FORWARD, interpolate="none") == "none"
    assert interpolation(motion=FORWARD, config=tmp_path / "run.toml") == "blend"


def test_a_stream_of_frames_that_carry_motion():
    class Rendered(Video):
        has_motion = True

        def __getitem__(self, index):
            motion = MotionVectors(FORWARD[index], BACKWARD[index], DEPTH[index])
            return Frame(self.pixels[index], self.times_us[index], motion=motion)

    stream = Rendered(FILM, [40_000 * index for index in range(len(FILM))])
    options = {"simulator": "esim"}
    events = texvent.simulate(stream, **options)
    assert events.metadata["settings"]["interpolate"]["interpolate"] == "motion"
    given = texvent.simulate(
        FILM, fps=25, motion=FORWARD, motion_back=BACKWARD, depth=DEPTH, **options
    )
    assert np.array_equal(events.t, given.t)


@pytest.mark.parametrize(("missing", "is_refused"), [(2, True), (5, False)])
def test_a_missing_file_is_not_taken_for_one_field_per_pair(tmp_path, missing, is_refused):
    for index in set(range(6)) - {missing}:
        np.save(tmp_path / f"flow_{index:04}.npy", FORWARD[index])
    config = CaptureConfig(fps=Fraction(25), motion=tmp_path)
    if is_refused:
        with pytest.raises(InputError, match=r"between flow_0001\.npy and flow_0003\.npy"):
            open_frames(FILM, config)
    else:
        check_exact(open_frames(FILM, config), backward=False)


def test_depth_and_ids_in_images(tmp_path):
    for name, values in (("depth", (DEPTH * 1000).astype(np.uint16)), ("ids", INSTANCES)):
        (tmp_path / name).mkdir()
        for index, one in enumerate(values):
            cv2.imwrite(str(tmp_path / name / f"{index}.png"), one.astype(np.uint16))
    options = {"depth": tmp_path / "depth", "instances": tmp_path / "ids", "depth_scale": 1e-3}
    motions = check_exact(opened({"motion": FORWARD}, **options), backward=False)
    np.testing.assert_allclose(motions[2].depth, DEPTH[2], 1e-6)
    assert np.array_equal(motions[2].instance, INSTANCES[2])
    with pytest.raises(InputError, match="is an image; vectors are read from"):
        opened({"motion": tmp_path / "ids"})
    cv2.imwrite(str(tmp_path / "depth" / "2.png"), np.zeros((48, 64, 3), np.uint8))
    with pytest.raises(FileFormatError, match=r"2\.png is a colour image; depth is one channel"):
        list(opened({"motion": FORWARD}, **options))


def test_no_surface_is_infinitely_far():
    depth = DEPTH.copy()
    depth[:, 0, 0], depth[:, 0, 1] = 0.0, 1e10  # KITTI's and Isaac's mark, and Blender's
    found = next(iter(opened({"motion": FORWARD, "depth": depth}))).motion.depth
    assert np.isinf(found[0, :2]).all()
    assert np.isfinite(found).sum() == found.size - 2
