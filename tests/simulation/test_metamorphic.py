"""Relations between runs: the clip changed, or the way to go through it, and the events known."""

import dataclasses
import itertools
from collections import Counter
from typing import Any, Literal, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np
import pytest

import texvent
from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.events import EventStream
from texvent.options.values import option_names
from texvent.runtime import threads

HEIGHT, WIDTH, COUNT, STEP_US = 18, 24, 5, 41_667
TIMES_US = STEP_US * np.arange(COUNT)


def waves(height: int = HEIGHT, width: int = WIDTH, count: int = COUNT) -> Any:
    """Waves that move to the left by 1 px per frame, [N, H, W] uint8, and their vectors."""
    index, y, x = np.ogrid[:count, :height, :width]
    levels = 125 + 120 * np.sin((x + index) / 2.3) * np.cos((y + 0.3 * x + 0.3 * index) / 3.1)
    vectors = np.broadcast_to(np.float32([-1, 0]), (count, height, width, 2))
    return np.round(levels).astype(np.uint8), {"motion": vectors, "motion_back": -vectors}


CLIP, VECTORS = waves()
GAINS = np.array([1, 0.85, 1.05, 0.9, 1])[:, None, None]
HALF_AT_REST = np.where(np.arange(HEIGHT)[:, None] < 9, CLIP, CLIP[0])
FLICKERING = np.round((60 + 0.4 * HALF_AT_REST) * GAINS).astype(np.uint8)

MODELS = {name: SIMULATORS.load(name) for name in SIMULATORS.builtin}
SOURCES: dict[str, dict[str, Any]] = {"none": {}, "blend": {}, "flow": {}, "motion": VECTORS}
"""Interpolators of ordinary frames, and what they need beside them."""
EXACT = {"none", "blend"}
"""Those that do not know left from right; others search from the left, or round places."""
OTHERS = {"exact", "rife"}
"""One draws instants, not frames, the other needs weights."""
LOUD = {
    "noise_rate_hz": 20.0, "noise_intensity": 120.0, "shot_noise_rate_hz": 20.0,
    "leak_rate_hz": 5.0, "threshold_sigma": 0.03, "hot_pixel_fraction": 0.1,
    "initial_phase": "random", "timestamp_rule": "random",
    "contrast_threshold_on": 0.2, "contrast_threshold_off": 0.2, "scan_period_ns": 7_000_013,
}  # fmt: skip
"""Everything random and a scan, for the models that have it; thresholds that flicker reaches."""
QUIET = {
    "shot_noise_rate_hz": 0.0, "threshold_sigma": 0.0, "leak_rate_decades": 0.0,
    "hot_pixel_fraction": 0.0, "initial_phase": "zero", "scan_period_ns": 0, "noise_rate_hz": 0.0,
}  # fmt: skip
"""Nothing random, nor a scan, which knows left from right."""


class Run(NamedTuple):
    """A model, one of its presets, and an interpolator."""

    model: str
    preset: str
    interpolate: str

    def loud(self, **more: Any) -> dict[str, Any]:
        """Options with everything random."""
        return self._options(LOUD, 20.0, {"k6": 1e-3}) | more

    def quiet(self) -> dict[str, Any]:
        """Options with nothing random."""
        return self._options(QUIET, 0.0, {"k3": 0.0, "k6": 0.0})

    def _options(self, wanted: dict[str, Any], noise: float, constants: Any) -> dict[str, Any]:
        config = MODELS[self.model].presets[self.preset]
        known = set(option_names(type(config)))
        rules = getattr(config, "idle_with", {}).items()
        known -= {name for name, (one, values) in rules if getattr(config, one, None) in values}
        options = {name: value for name, value in wanted.items() if name in known}
        if hasattr(config, "noise_curve"):
            options["noise_scale"] = noise
        if hasattr(config, "constants"):
            options["constants"] = str(config.k._replace(**constants))
        if self.interpolate != "none":
            options["max_intermediate"] = 6
        own = {"simulator": self.model, "preset": self.preset, "interpolate": self.interpolate}
        return {**own, "label_noise": True, "seed": 4, **options}


FIRST = {name: next(iter(model.presets)) for name, model in MODELS.items()}
LAST = {name: list(model.presets)[-1] for name, model in MODELS.items()}
RUNS = list(dict.fromkeys([
    *(Run(*one, "none") for one in (*FIRST.items(), *LAST.items())),
    *(Run(*one, "flow") for one in FIRST.items()),
    *(Run("texvent", "accurate", one) for one in SOURCES),
]))  # fmt: skip
"""Two presets of every model, every model with flow, which some fuse, and every interpolator."""


def runs(*interpolators: str) -> Any:
    """The test for the runs of some interpolators, or of all."""
    chosen = [run for run in RUNS if run.interpolate in (interpolators or SOURCES)]
    return pytest.mark.parametrize("run", chosen, ids="-".join)


def other_choices() -> list[tuple[str, dict[str, Any]]]:
    """Every model with each of its options that are choices at another value than usual."""
    found = []
    for name, model in MODELS.items():
        usual = model.presets[FIRST[name]]
        for option, kind in get_type_hints(type(usual)).items():
            values = (False, True) if kind is bool else get_args(kind)
            values = values if kind is bool or get_origin(kind) is Literal else ()
            found += [(name, {option: one}) for one in values if one != getattr(usual, option)]
    return found


def simulate(frames: Any = CLIP, t_us: Any = TIMES_US, **options: Any) -> EventStream:
    """Events of frames, with their vectors where they are followed."""
    options = {**SOURCES[options["interpolate"]], **options}
    return texvent.simulate(frames, t_us=t_us, progress=False, **options)


def rows(events: EventStream, place: Any = lambda x, y: (x, y)) -> list[Any]:
    """All columns of every event, sorted, at places that a function of x and y gives."""
    columns = events.columns()
    columns["x"], columns["y"] = place(events.x.astype(int), events.y.astype(int))
    return sorted(zip(*(column.tolist() for column in columns.values()), strict=True))


def test_no_interpolator_is_forgotten():
    assert set(SOURCES) | OTHERS == set(INTERPOLATORS.builtin)


@runs()
def test_the_same_levels_of_any_type_give_the_same_events(run):
    for frames, deflicker in ((CLIP, False), (FLICKERING, True)):
        if deflicker and run.interpolate == "motion":
            continue  # vectors do not explain a gain
        options = run.loud(deflicker=deflicker)
        events = simulate(frames, **options)
        assert not deflicker or events != simulate(frames, **run.loud())
        assert simulate(frames.astype(np.uint16) * np.uint16(257), **options) == events
        assert simulate(frames.astype(np.float32), **options) == events
        for white in (1.0, 127.5):
            assert simulate(frames / 255 * white, white_level=white, **options) == events


@runs()
def test_shifting_the_clip_shifts_the_events_and_nothing_else(run):
    events = simulate(**run.loud())
    assert len(events) > 100
    for shift_us in (-3_000_017, 10**12):
        moved = dataclasses.replace(events, t=events.t + shift_us)
        assert simulate(t_us=TIMES_US + shift_us, **run.loud()) == moved


@pytest.mark.parametrize(("model", "choice"), other_choices(), ids=str)
def test_whatever_is_chosen_a_clip_that_begins_later_or_comes_frame_by_frame_fires_as_usual(
    model, choice
):
    usual = MODELS[model].presets[FIRST[model]]
    choice |= {"multi_event": False} if choice == {"timestamp_rule": "eq7"} else {}
    options = Run(model, FIRST[model], "none").loud(**choice)
    for name, (one, values) in getattr(usual, "idle_with", {}).items():
        if choice.get(one) in values:
            options.pop(name, None)
    events = simulate(**options)
    assert len(events) > 100
    moved = dataclasses.replace(events, t=events.t + 10**12)
    assert simulate(t_us=TIMES_US + 10**12, **options) == moved
    with texvent.EventCamera((WIDTH, HEIGHT), **options) as camera:
        for _ in range(2):
            packets = [camera.step(*one) for one in zip(CLIP, TIMES_US, strict=True)]
            assert EventStream.concat([*packets, camera.finish()]) == events
            camera.reset()


@runs("none", "blend", "flow")
def test_frames_given_one_by_one_give_the_events_of_the_clip(run):
    options = run.loud(deflicker=True)
    whole = simulate(FLICKERING, **options)
    with texvent.EventCamera((WIDTH, HEIGHT), **options) as camera:
        for _ in range(2):
            packets = [camera.step(*one) for one in zip(FLICKERING, TIMES_US, strict=True)]
            assert EventStream.concat([*packets, camera.finish()]) == whole
            for start_us, packet in zip(TIMES_US - STEP_US, packets, strict=True):
                assert ((packet.t >= start_us) & (packet.t < start_us + STEP_US)).all()
            camera.reset()


@runs()
def test_a_run_from_a_frame_on_is_that_of_the_frames_from_there(run):
    late_us, options = TIMES_US + 9_000_000, run.loud()
    part = simulate(t_us=late_us, start=2 * STEP_US / 1e6, **options)
    more = {key: one[2:] for key, one in SOURCES[run.interpolate].items()}
    assert part == simulate(CLIP[2:], late_us[2:], **options, **more)
    begun = simulate(t_us=late_us, stop=3 * STEP_US / 1e6, **options)
    assert begun == simulate(t_us=late_us, **options).cut(0, late_us[2])


# The frames turned, the signs of their vectors, and the place of an event.
TURNED = {
    "left-right": (lambda one: one[:, :, ::-1], (-1, 1), lambda x, y: (WIDTH - 1 - x, y)),
    "up-down": (lambda one: one[:, ::-1], (1, -1), lambda x, y: (x, HEIGHT - 1 - y)),
    "transposed": (lambda one: one.swapaxes(1, 2), (1, 1), lambda x, y: (y, x)),
}


@runs()
def test_a_turned_clip_gives_the_turned_events(run):
    events = simulate(**run.quiet())
    assert len(events) > 100
    for way, (turn, signs, place) in TURNED.items():
        fields = SOURCES[run.interpolate].items()
        vectors = {key: turn(one) * np.float32(signs) for key, one in fields}
        if way == "transposed":
            vectors = {key: one[..., ::-1] for key, one in vectors.items()}
        expected = rows(events, place)
        found = rows(simulate(turn(CLIP), **run.quiet(), **vectors))
        if run.interpolate in EXACT:
            assert found == expected, way
        counts = [Counter((x, y, p) for x, y, _, p, _ in one) for one in (expected, found)]
        assert (counts[0] & counts[1]).total() > 0.98 * max(len(expected), len(found)), way


@runs(*EXACT)
def test_at_twice_the_size_each_pixel_has_its_events_four_times(run):
    small = simulate(**run.quiet())
    places = itertools.product((0, 1), repeat=2)
    parts = [rows(small, lambda x, y, i=i, j=j: (2 * x + i, 2 * y + j)) for i, j in places]
    large = simulate(CLIP.repeat(2, 1).repeat(2, 2), **run.quiet())
    assert rows(large) == sorted(itertools.chain(*parts))


@runs()
def test_the_seed_decides_everything_random(run):
    events = simulate(**run.loud())
    assert simulate(**run.loud()) == events
    assert simulate(**run.loud(seed=5)) != events
    assert simulate(**run.quiet()) == simulate(**run.quiet() | {"seed": 5})


SHARED = [
    *(Run(name, FIRST[name], "none") for name in ("physical", "v2e", "voltmeter")),
    *(Run(*one, "flow") for one in FIRST.items()),
    Run("texvent", "accurate", "motion"),
]
"""Runs whose kernels share a frame, or the frames of a pair, out among threads."""


@pytest.mark.parametrize("run", SHARED, ids="-".join)
def test_any_number_of_threads_gives_the_same_events_and_has_work(run, small_parts, monkeypatch):
    clip, vectors = waves(100, 150, 3)
    options = run.loud() if run.interpolate == "none" else run.loud(fixed_count=4)
    options |= vectors if run.interpolate == "motion" else {}
    streams = []
    for count in (1, 3):
        monkeypatch.setenv(threads.THREADS_VARIABLE, str(count))
        streams.append(simulate(clip, TIMES_US[:3], **options))
    assert max(small_parts) >= 3
    assert streams[0] == streams[1]
