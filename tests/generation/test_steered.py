"""Videos that follow a scene: control videos, agreement, motion and truth, without a network."""

import dataclasses
import inspect
import tracemalloc
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from tests.scenes.assets.glb_bar import write_bar

from texvent._registry import GENERATORS
from texvent.capture.prepare import PreparedFrames
from texvent.config import CaptureConfig
from texvent.dataset import SampleSource, Specification
from texvent.dataset.generation.recipe import VIDEOS, Recipe
from texvent.dataset.specification.specification import Filters
from texvent.errors import ConfigError, InputError
from texvent.frames import Video, frame_time_us
from texvent.generation.control_video import KINDS, draw_control, id_colours, times_of
from texvent.generation.steered_video import SteeredVideo
from texvent.generation.video_models import model_files
from texvent.generation.video_models.controls import PIPELINES
from texvent.generation.video_models.known_models import MODELS, check_control
from texvent.interpolate.motion.layers import gamma_coded, linear
from texvent.pipeline import video_to_events
from texvent.run.prepare import report_prompt
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.truth.source import TruthSource
from texvent.video_check.control_agreement import measure_agreement

SENTENCE = "a red car drives left past a tree"
STEERED = {name: row for name, row in MODELS.items() if row.steering is not None}


def stage(width=64, height=48):
    kind = GENERATORS.load("procedural")
    config = dataclasses.replace(kind.config_type(), fps=Fraction(16), duration=0.26)
    return kind(config, seed=1, size=SensorSize(width, height)).generate(SENTENCE)


@pytest.fixture(scope="module")
def scene():
    return stage()


@pytest.fixture(scope="module")
def rendered(scene):
    return np.stack([np.clip(frame.pixels, 0, 255).astype(np.uint8) for frame in scene])


def steer(scene, pixels):
    """A video as a model would make it, of these pixels."""
    video = Video(pixels, times_of(scene), scene.fps, {"generator": "test"})
    shape = scene.fps, scene.size, scene.frame_count
    return SteeredVideo(*shape, video.metadata, video=video, scene=scene)


@pytest.mark.parametrize("name", ["procedural", *STEERED])
def test_a_report_is_of_the_staged_scene_unless_it_is_asked_for_otherwise(name):
    part = GENERATORS.load(name)
    report = part(part.config_type(), seed=1, size=SensorSize(64, 48)).report
    usual = inspect.signature(report_prompt).parameters["is_staged"].default
    assert inspect.signature(report).parameters["is_staged"].default is usual is True


def truths(scene):
    times = times_of(scene)
    return [scene.ground_truth(*pair) for pair in zip(times, [*times[1:], times[-1]], strict=True)]


def test_every_control_that_a_model_takes_is_drawn_frame_by_frame(scene):
    taken = {control for one in PIPELINES.values() for control in one.controls}
    assert taken == set(KINDS)
    for kind in KINDS:
        control = draw_control(scene, kind)
        assert control.dtype == np.uint8
        assert control.shape == (scene.frame_count, *scene.size.shape, 3)
        assert len(np.unique(control)) > 1, kind


def test_depth_is_inverse_over_the_clip_and_ids_are_flat_colours(scene):
    known = truths(scene)
    inverse = 1 / np.stack([one.depth for one in known]).astype(float)
    wanted = np.rint(255 * (inverse - inverse.min()) / (inverse.max() - inverse.min()))
    depth = draw_control(scene, "depth")
    assert np.abs(depth - wanted[..., None]).max() <= 1
    assert (depth[~np.isfinite(np.stack([one.depth for one in known]))] == 0).all()
    ids = np.stack([one.instance for one in known])
    colours = id_colours(int(ids.max()))
    assert len(np.unique(colours, axis=0)) == len(colours)
    assert np.array_equal(draw_control(scene, "ids"), colours[ids])


def test_rest_is_white_and_motion_to_the_left_cyan(scene):
    flow = draw_control(scene, "flow")
    vectors = truths(scene)[0].flow
    rests = np.hypot(*np.moveaxis(vectors, -1, 0)) == 0
    left = vectors[..., 0] < 0.6 * np.nanmin(vectors[..., 0])
    assert (flow[1][rests] == 255).all()
    red, green, blue = np.median(flow[1][left], axis=0)
    assert red < min(green, blue)
    assert np.array_equal(flow[0], flow[1])


def test_the_flow_of_a_long_clip_is_coloured_frame_by_frame():
    flow = np.random.default_rng(0).normal(size=(64, 64, 2)).astype(np.float32)
    truth = SimpleNamespace(flow=flow)
    clip = SimpleNamespace(fps=16, frame_count=81, ground_truth=lambda *_: truth)
    tracemalloc.start()
    drawn = draw_control(clip, "flow")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert drawn.shape == (81, 64, 64, 3)
    assert peak < 30 * drawn[..., 0].size


def test_agreement_tells_a_video_of_the_scene_from_others(scene, rendered):
    noise = np.random.default_rng(0).integers(0, 255, rendered.shape, np.uint8)
    still = np.repeat(rendered[:1], len(rendered), axis=0)
    own, other, resting, back, moved = (
        measure_agreement(steer(scene, pixels).plain, scene)
        for pixels in (rendered, noise, still, rendered[::-1], np.roll(rendered, 16, axis=2))
    )
    assert own["edges"] > 0.5
    assert own["flow"] > 0.5
    assert max(other.values()) < 0.3
    assert resting["flow"] < 0.1
    assert back["flow"] < 0.2
    assert moved["edges"] < 0.5 * own["edges"]


def test_truth_is_the_scenes_and_motion_leads_to_both_neighbours(scene, rendered):
    video = steer(scene, rendered)
    times = times_of(scene)
    frames = list(video)
    assert np.array_equal(np.stack([frame.pixels for frame in frames]), rendered)
    for index, frame in enumerate(frames):
        forward, backward = frame.motion.forward, frame.motion.backward
        if index + 1 < len(frames):
            wanted = scene.ground_truth(times[index], times[index + 1])
            assert np.array_equal(forward, wanted.flow, equal_nan=True)
            assert np.array_equal(frame.motion.depth, wanted.depth)
        if index:
            wanted = scene.ground_truth(times[index], times[index - 1])
            assert np.array_equal(backward, wanted.flow, equal_nan=True)
    assert frames[0].motion.backward is None
    assert frames[-1].motion.forward is None
    parts = ("flow", "flow-back", "depth", "ids", "boxes", "poses")
    of_video, of_scene = (TruthSource(one, parts).at(frames[1], times[0], times[2])
                          for one in (video, scene))  # fmt: skip
    for part, row in of_scene.rows.items():
        for name, values in row.items():
            found = of_video.rows[part][name]
            assert np.array_equal(found, values, equal_nan=part in ("flow", "flow-back")), part


@pytest.mark.parametrize("kind", ["depth", "ids"])
def test_events_of_a_model_that_returns_its_control_move_with_the_scene(scene, kind):
    """Between two frames the control is drawn where it is at that instant, not blended."""
    settings = resolve("generate", {"interpolate": "motion", "noise": "none", "fixed_count": 1})
    run = video_to_events(steer(scene, draw_control(scene, kind)), settings)
    between = [frame for frame, _ in run.steps() if not frame.is_source]
    assert len(between) == scene.frame_count - 1
    finer = SimpleNamespace(
        fps=2 * scene.fps, frame_count=2 * scene.frame_count - 1, ground_truth=scene.ground_truth
    )
    there = draw_control(finer, kind).astype(float) @ [0.299, 0.587, 0.114]
    for index, frame in enumerate(between):
        ends = there[2 * index], there[2 * index + 2]
        exact = there[2 * index + 1]
        changed = np.abs(ends[1] - ends[0]) > 8
        blended = np.abs((ends[0] + ends[1]) / 2 - exact)[changed].mean()
        moved = np.abs(frame.luma - exact)[changed].mean()
        assert moved < 0.5 * blended


class Slide:
    """A square that slides before a wall, `dx` and `dy` px per frame, as a scene of two layers."""

    fps, size, frame_count = Fraction(16), SensorSize(64, 48), 4
    top, left, rows, columns = 18, 24, 12, 16

    def __init__(self, dx, dy):
        self.velocity = np.array([dx, dy]) / frame_time_us(1, self.fps)

    def cover(self, t_us):
        """Share of each pixel that the square covers, by its exact place."""
        dx, dy = self.velocity * t_us

        def along(start, length, count):
            at = np.arange(count)
            return np.clip(np.minimum(start + length, at + 1) - np.maximum(start, at), 0, 1)

        rows = along(self.top + dy, self.rows, self.size.height)
        return np.outer(rows, along(self.left + dx, self.columns, self.size.width))

    def ground_truth(self, t0_us, t1_us):
        is_square = self.cover(t0_us) > 0.5
        flow = np.where(is_square[..., None], self.velocity * (t1_us - t0_us), 0)
        depth = np.where(is_square, 2, 10).astype(np.float32)
        return SimpleNamespace(
            flow=flow.astype(np.float32), depth=depth, instance=is_square.astype(np.int32)
        )


@pytest.mark.parametrize("count", [1, 3])
@pytest.mark.parametrize("velocity", [(2, 0), (3, 1), (-4, 2), (5, -3), (1, 0)])
def test_motion_between_frames_of_a_model_that_returns_its_control_is_exact(velocity, count):
    """At every instant, of whole pixels and of parts of them: contours by area, in linear light."""
    scene = Slide(*velocity)
    control = draw_control(scene, "ids")
    frames = Video(control, times_of(scene), scene.fps, {})
    video = SteeredVideo(scene.fps, scene.size, 4, {}, video=frames, scene=scene)
    settings = resolve("generate", {"interpolate": "motion", "noise": "none", "fixed_count": count})
    steps = video_to_events(video, settings).steps()
    between = [frame for frame, _ in steps if not frame.is_source]
    assert len(between) == 3 * count
    wall, square = (linear(float(one @ LUMA)) for one in id_colours(1).astype(float))
    for frame in between:
        share = scene.cover(frame.t_us)
        light = share * square + (1 - share) * wall
        exact = np.vectorize(gamma_coded)(light)
        assert np.abs(frame.luma - exact).max() < 0.01


LUMA = np.array([0.299, 0.587, 0.114])


def test_truth_of_frames_that_are_fitted_to_a_sensor_is_that_of_the_part_it_sees(scene, rendered):
    small = PreparedFrames(steer(scene, rendered), CaptureConfig(), size=SensorSize(24, 24))
    frames = list(small)
    times = times_of(scene)
    parts = ("flow", "depth", "ids", "boxes", "poses", "events")
    source = TruthSource(small, parts)
    truth = source.at(frames[1], times[0], times[2])
    window = slice(8, 56)
    ids = scene.ground_truth(times[1], times[1]).instance[:, window]
    assert np.array_equal(truth.rows["ids"]["instance"], ids[1::2, 1::2])
    flow = scene.ground_truth(times[1], times[2]).flow[1::2, window][:, 1::2] / 2
    assert np.allclose(truth.rows["flow"]["flow"], flow, equal_nan=True)
    box = truth.rows["boxes"]["boxes"][0]
    assert np.isfinite(truth.rows["boxes"]["visibility"]).all()
    assert 0 <= box["x"] < box["x"] + box["w"] <= 24
    fx, _, cx, _ = truth.rows["poses"]["intrinsics"]
    whole = TruthSource(scene, parts).at(frames[1], times[0], times[2]).rows["poses"]["intrinsics"]
    assert fx == pytest.approx(whole[0] / 2)
    assert cx == pytest.approx(11.5)
    points = np.array([[6.25, 12.25], [18.25, 20.25]])
    wanted = scene.instances_at(times[1], points * 2 + [8, 0])
    assert np.array_equal(source.video.instances_at(times[1], points), wanted)


def test_what_leaves_the_part_that_a_sensor_sees_is_occluded(scene, rendered):
    narrow = PreparedFrames(steer(scene, rendered), CaptureConfig(), size=SensorSize(16, 48))
    times = times_of(scene)
    row = TruthSource(narrow, ("flow",)).at(next(iter(narrow)), None, times[-1]).rows["flow"]
    x = np.arange(16) + 0.5 + row["flow"][..., 0]
    leaves = (x < 0) | (x >= 16)
    assert leaves.any()
    assert row["occluded"][leaves].all()
    assert not row["occluded"].all()


def test_events_of_black_bars_are_of_nothing(scene, rendered):
    tall = PreparedFrames(
        steer(scene, rendered), CaptureConfig(fit="contain"), size=SensorSize(64, 96)
    )
    fitted = TruthSource(tall, ("events",)).video
    rows, columns = np.indices((96, 64)) + 0.5
    depth, instance = fitted.instances_at(0, np.stack([columns.ravel(), rows.ravel()], axis=-1))
    truth = fitted.ground_truth(0, 0)
    assert np.isinf(truth.depth[:24]).all()
    assert np.array_equal(instance.reshape(96, 64), truth.instance)
    assert np.allclose(depth.reshape(96, 64), truth.depth)


@pytest.mark.parametrize("name", STEERED)
def test_controls_lengths_and_sizes_that_a_row_does_not_take_are_refused_before_loading(name):
    row = STEERED[name]
    lora = {"lora": ("x.safetensors",)} if row.steering.needs_lora else {}
    usual = dataclasses.replace(GENERATORS.load(name).config_type(), **lora)
    assert (usual.frames - 1) % row.steering.step == 0
    assert usual.control == row.steering.controls[0]
    check_control(row, usual)
    faults = {"frames": usual.frames + 1, "width": usual.width + 8, "control": None}
    if row.longest is not None:
        faults |= {"frames ": row.longest + row.steering.step}
    for control in set(KINDS) - set(row.steering.controls):
        faults |= {f"control{' ' * (1 + len(faults))}": control}
    for option, value in faults.items():
        with pytest.raises(ConfigError, match=f"{option.strip()} is .*{name} "):
            check_control(row, dataclasses.replace(usual, **{option.strip(): value}))
    if lora:
        with pytest.raises(ConfigError, match="follows a scene by a LoRA, and none is given"):
            check_control(row, dataclasses.replace(usual, lora=()))


def test_models_of_the_user_are_in_the_scene_that_a_video_follows(tmp_path):
    write_bar(tmp_path / "magic_wand.glb")
    part = GENERATORS.load("wan-vace-1.3b")
    small = {"frames": 5, "width": 64, "height": 48, "assets": tmp_path}
    config = dataclasses.replace(part.config_type(), **small)
    generator = part(config, seed=0, size=None)
    control = generator.draw("a magic wand moves left")
    assert control.frame_count == 5
    assert "magic wand" in generator._steering.scene.class_names.values()
    assert "files" in generator._request_facts()
    bare = part(dataclasses.replace(config, assets=None), seed=0, size=None)
    with pytest.raises(InputError, match="nothing in the prompt was understood: magic wand"):
        bare.draw("a magic wand moves left")


def test_a_model_that_follows_no_scene_says_which_do():
    config = dataclasses.replace(GENERATORS.load("wan-1.3b").config_type(), look="rain")
    with pytest.raises(ConfigError, match=r"wan-1\.3b follows no scene; models that do: wan-vace"):
        check_control(MODELS["wan-1.3b"], config)


@pytest.mark.parametrize("is_stored", [True, False])
def test_a_data_set_filters_by_agreement_where_its_videos_are_made(is_stored):
    recipe = Recipe.of(
        Specification(
            name="steered",
            sources=(SampleSource(prompts=(SENTENCE,)),),
            options={"generator": "wan-vace-1.3b"},
            filters=Filters(least_control_agreement=0.5),
            store_videos=is_stored,
        )
    )
    (variant,) = recipe.variants
    source = recipe.settings[VIDEOS if is_stored else variant].extremes[0].source
    assert (source.least_agreement, source.on_failure) == (0.5, "retry")


@pytest.mark.parametrize(
    ("kept", "is_whole"),
    [((), False), (("config.json",), False), (("a.safetensors",), False),
     (("config.json", "a.safetensors"), True)],
)  # fmt: skip
def test_a_network_whose_download_was_interrupted_is_fetched_on(
    kept, is_whole, tmp_path, monkeypatch
):
    for name in kept:
        (tmp_path / name).write_text("{}")

    def snapshot_download(repo, *, local_files_only=False, **_):
        fetched.append(not local_files_only)
        if local_files_only and not kept:
            raise OSError("nothing is here")
        return str(tmp_path)

    fetched, said = [], []
    hub = SimpleNamespace(snapshot_download=snapshot_download)
    monkeypatch.setattr(model_files, "require", lambda *_, **__: hub)
    assert model_files.find_network("org/name", "depth", said.append) == tmp_path
    assert fetched == ([False] if is_whole else [False, True])
    assert bool(said) is not is_whole
