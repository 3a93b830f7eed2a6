"""Networks trained on simulated events of objects, tested on recorded ones: all steps.

Frames, windows and predictions are files in the plan's folder, named after all that they depend on,
so that a run that was stopped goes on.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.dataset.specification.items import Item, read_items
from texvent.errors import InputError, warnings_to
from texvent.events import EventStream
from texvent.extending import require
from texvent.frames import Frame
from texvent.runtime.files.cache_folder import make_folder
from texvent.sensor import SensorSize
from texvent.view.video_writer import write_clips
from texvent_lab.bench.digits.training import predict, train_network
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.kept_results import is_whole, make_missing, write_arrays
from texvent_lab.bench.objects.arms import Arm, Test, clip_name
from texvent_lab.bench.objects.clips import (
    PILOT,
    Simulate,
    at_frames,
    count_pixels,
    frames_of,
    make_windows,
    match_threshold,
    render_clip,
    simulate_clip,
    stream_clip,
)
from texvent_lab.bench.objects.plan import (
    CLASSES,
    ObjectsPlan,
    Run,
    Training,
)
from texvent_lab.bench.objects.recorded import (
    SIDE,
    TABLE_CLASSES,
    Frames,
    in_cells,
    read_table,
    read_turntables,
)
from texvent_lab.bench.objects.results import (
    RECORDED,
    ObjectsReport,
    WindowSet,
    score_all,
)
from texvent_lab.train.schedule import EXTRA


def run_objects(
    plan: ObjectsPlan, *, jobs: int = 1, progress: Progress = no_progress
) -> ObjectsReport:
    """Render, simulate, train and test what was not before.

    Args:
        plan: see `ObjectsPlan`.
        jobs: processes to use.
        progress: told of every step.

    Raises:
        MissingDependencyError: torch or pycocotools is not installed.
        InputError, FileFormatError: the recordings are missing or of another layout.
        ConfigError: jobs is below 1.
    """
    start = time.perf_counter()
    check_range("jobs", jobs, 1)
    require("torch", extra=EXTRA)
    require("pycocotools.cocoeval", extra="texvent-lab[detection]")
    run = Run(
        plan, {"table": read_table(plan.frames), "turntable": read_turntables(plan.turntables)}
    )
    plan.check_events()
    make_folder(plan.work)
    tests: Sequence[Test] = list(CLASSES)
    clips = {
        run.frames_path(arm, one): (arm, one)
        for test in tests
        for arm in plan.sets[test].values()
        for one in arm.items
    }
    todo = list(clips.values())
    make_missing(render, run, todo, run.frames_path, jobs=jobs, progress=progress)
    sets = [(test, name) for test in tests for name in plan.sets[test]]
    make_missing(simulate, run, sets, run.windows_path, jobs=jobs, progress=progress)
    # Seed by seed: a run that is stopped has whole rounds.
    networks = sorted(
        (
            (one,)
            for test in tests
            for arm in (*plan.sets[test], None)
            for one in run.trainings(test, arm)
        ),
        key=lambda key: key[0].seed,
    )
    make_missing(train, run, networks, run.prediction_path, jobs=jobs, progress=progress)
    progress("scores")
    return ObjectsReport(
        environment=describe_environment(),
        protocol=_protocol(run),
        **{
            test: score_all(
                run.recorded[test], CLASSES[test], *_found(run, test), reference=plan.reference
            )
            for test in tests
        },
        reference=plan.reference,
        seconds=time.perf_counter() - start,
    )


def write_frames(plan: ObjectsPlan, folder: Path, *, overwrite: bool) -> None:
    """The frames that every arm is given, for programs that are not texvent's simulators.

    Args:
        plan: the clips.
        folder: gets a folder per clip of 8-bit PNG files with their times in timestamps.txt, s.
        overwrite: whether a folder of such folders may be replaced.

    Raises:
        OutputError: the folder holds something else, or cannot be written.
    """
    run = Run(plan, {})
    make_folder(plan.work)
    arms = {test: Arm(one, {}) for test, one in plan.specifications.items()}

    def rendered() -> Iterator[tuple[str, Iterator[Frame]]]:
        for name, (test, item) in plan.clip_names.items():
            path = run.frames_path(arms[test], item)
            if not is_whole(path):
                render(run, arms[test], item)
            yield name, frames_of(path)

    write_clips(rendered(), folder, overwrite=overwrite)


def render(run: Run, arm: Arm, item: Item) -> str:
    """Render a clip."""
    with warnings_to(_leave_out):  # of objects out of view, which windows leave out too
        return render_clip(item, arm.specification.options, run.frames_path(arm, item))


def _leave_out(warning: str) -> None:
    del warning


def simulate(run: Run, test: Test, name: str) -> str:
    """Make the windows of an arm, with the threshold that gives the recorded share."""
    arm = run.plan.sets[test][name]
    paths = [run.frames_path(arm, one) for one in arm.items]
    events_of, target = _simulator(run, test, arm), run.target(test)
    with warnings_to(_leave_out):  # of clips at rest
        threshold = arm.threshold[0] if len(arm.threshold) == 1 else None
        if arm.events is not None:
            count, pixels = count_pixels(paths[:PILOT], events_of)
            found, _ = arm.events.fit(count, round(target * pixels))
            threshold = None if found is None else found.threshold
        elif not arm.threshold and not arm.stream:
            threshold = match_threshold(paths[:PILOT], arm.options, events_of, target)
        numbers = [CLASSES[test].index(one.label or "") for one in arm.items]
        thresholds = [arm.threshold_of(one.stem, threshold) for one in paths]
        frames, events = make_windows(paths, numbers, events_of, thresholds)
    if test == "table":
        frames = frames.select(np.isfinite(frames.boxes[:, 0]))
    facts = {"threshold": np.nan if threshold is None else threshold, "events": events}
    write_arrays(run.windows_path(test, name), **vars(frames), **facts)
    share = float((frames.images != 0).mean())
    return (
        f"{test}, {name}: threshold {threshold}, {share:.3f} of pixels, {len(frames.images)} "
        "windows"
    )


def _simulator(run: Run, test: Test, arm: Arm) -> Simulate:
    """Maker of the events of an arm of the frames of a clip."""
    files = arm.events
    if files is not None:
        names = {run.frames_path(arm, one): clip_name(test, one) for one in arm.items}
        size, span_us = SensorSize(SIDE, SIDE), (0, run.plan.duration_us(test) + 1)
        return lambda path, threshold: files.packets(
            names[path], size, span_us, threshold
        ).collect()

    def simulated(path: Path, threshold: float | None) -> EventStream:
        if arm.stream:
            events = stream_clip(path, arm.stream)
        else:
            events = simulate_clip(path, arm.options, threshold)
        return at_frames(path, events) if arm.times == "frames" else events

    return simulated


def train(run: Run, one: Training) -> str:
    """Train a network, and keep its predictions of the recorded windows, or of their other half."""
    recorded, test = run.recorded[one.test], np.ones(len(run.recorded[one.test].images), np.bool_)
    if one.arm is None:
        test = run.half(one.test, one.fold)
        learned = recorded.select(~test)
    else:
        learned = read_windows(run.windows_path(one.test, one.arm))
    if not len(learned.images):
        raise InputError(f"{one.test}, {one.arm or RECORDED}: there are no windows to learn from")
    plan, started = run.plan, time.perf_counter()
    found: NDArray[Any]
    options: dict[str, Any] = {"steps": plan.steps, "schedule": plan.schedule, "seed": one.seed}
    options["precision"] = plan.precision
    if one.test == "table":
        from texvent_lab.bench.objects.locator import locate, train_locator  # imports torch

        network = train_locator(learned, len(TABLE_CLASSES), **options)
        found = locate(network, recorded.images[test], len(TABLE_CLASSES))
        found["t"] = np.flatnonzero(test)[found["t"]]
    else:
        images = np.concatenate([in_cells(learned.images), in_cells(learned.images[:, :, ::-1])])
        network = train_network(images, np.tile(learned.classes, 2), **options)
        found = predict(network, in_cells(recorded.images[test]))
    write_arrays(run.prediction_path(one), found=found, numbers=np.flatnonzero(test))
    seconds = time.perf_counter() - started
    return f"{one.test}, {one.arm or 'recorded'}, seed {one.seed}: {seconds:.0f} s"


def read_windows(path: Path) -> Frames:
    """The windows of an arm."""
    with np.load(path) as file:
        return Frames(*(file[name] for name in ("images", "classes", "boxes", "groups")))


def _found(
    run: Run, test: Test
) -> tuple[dict[str, WindowSet], dict[str | None, list[NDArray[Any]]]]:
    """Sets of windows, and predictions per seed in the order of the recorded windows, by arm."""
    sets, found = {}, {}
    for arm in (*run.plan.sets[test], None):
        if arm is not None:
            path = run.windows_path(test, arm)
            with np.load(path) as file:
                threshold, events = float(file["threshold"]), int(file["events"])
            images = read_windows(path).images
            sets[arm] = WindowSet(
                threshold if math.isfinite(threshold) else None,
                events,
                len(images),
                float((images != 0).mean()),
            )
        per_seed: dict[int, list[Any]] = {}
        for one in run.trainings(test, arm):
            with np.load(run.prediction_path(one)) as file:
                per_seed.setdefault(one.seed, []).append((file["numbers"], file["found"]))
        found[arm] = [_joined(parts, test) for parts in per_seed.values()]
    return sets, found


def _joined(parts: list[tuple[NDArray[np.int64], NDArray[Any]]], test: Test) -> NDArray[Any]:
    numbers, found = (np.concatenate(one) for one in zip(*parts, strict=True))
    return found if test == "table" else found[np.argsort(numbers)]


def _protocol(run: Run) -> dict[str, Any]:
    plan = run.plan
    return {
        "clips": {test: len(read_items(one).all) for test, one in plan.specifications.items()},
        "steps of training": plan.steps,
        "batch size": plan.schedule.batch_size,
        "precision": plan.precision,
        "networks per arm": plan.seeds,
        "spread of thresholds": plan.spread,
        "recorded share of pixels with an event": {test: run.target(test) for test in CLASSES},
        "arms": {
            name: {"stream": arm.stream} if arm.stream else dict(arm.options)
            for test in ("turntable", "table")
            for name, arm in plan.sets[test].items()
        },
    }
