"""A detector trained on each simulator's events of the same clips, and tested on unseen ones.

Every step leaves its files in the plan's folder, so that a run that was stopped goes on: clips are
made and exported, a detector is trained for every arm and seed, and each is tested on the events of
its own arm and on a recorded street.
"""

from __future__ import annotations

import dataclasses
import json
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent import dataset
from texvent.config import check_range
from texvent.data.pull import find_pulled
from texvent.dataset.export import LEDGER_FILE, export
from texvent.dataset.layouts.rvt import WINDOW_US
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.verify import verify
from texvent.errors import ConfigError, InputError, TexventError, shown
from texvent.extending import require, suggest
from texvent.io.atomic import atomic_file
from texvent.io.files import open_events
from texvent.options.values import plain
from texvent.represent.histogram import stacked_histogram
from texvent.run.ledger import Ledger
from texvent.runtime.identity import digest
from texvent.runtime.progress import NO_PROGRESS
from texvent_lab.bench.clip_counts import with_count
from texvent_lab.bench.detection.clips import bin_pixels, read_clips, scale
from texvent_lab.bench.detection.config import EXTRA, DetectionConfig, DetectionData
from texvent_lab.bench.detection.labels import IGNORED, read_street_labels
from texvent_lab.bench.detection.precision import (
    ALL,
    PrecisionEstimate,
    average_precision,
    bootstrap,
)
from texvent_lab.bench.detection.results import ArmScore, DetectionReport
from texvent_lab.bench.detection.task import (
    as_boxes,
    detect_clips,
    detect_last,
    join_boxes,
)
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.jobs import Progress, no_progress, run_jobs
from texvent_lab.train.loop import TrainingState, train
from texvent_lab.train.schedule import Hardware, Schedule

CLASSES = "car,truck,bus,motorcycle,cyclist,pedestrian"
STREET = "davis346"
SCORES_FILE = "scores.json"
AP50 = (0.5,)
SIZES: Mapping[str, tuple[float, float]] = {
    "small": (0.0, 32.0**2),
    "medium": (32.0**2, 96.0**2),
    "large": (96.0**2, np.inf),
}
"""COCO's sizes, by the area of a box, px²."""
SAMPLES = 200
"""Resamples of the bootstrap over unseen clips."""
MOST_WINDOWS = 10
"""Memory of a detector before an instant of the street, in windows: that of a training clip."""


@dataclass(frozen=True, kw_only=True)
class DetectionPlan:
    """Clips, arms and networks.

    Raises:
        ConfigError: a value out of range.
    """

    specification: Path
    """Specification of the data set; each of its variants is an arm."""
    work: Path
    """Folder that keeps clips, networks and scores."""
    clips: int | None = None
    """Clips in all; None: as many as the specification says."""
    arms: tuple[str, ...] = ()
    """Variants to train on; none: all."""
    seeds: int = 1
    """Networks per arm."""
    passes: int = 1
    """Passes over the clips in an epoch."""
    schedule: Schedule = DetectionConfig().schedule

    def __post_init__(self) -> None:
        check_range("clips", self.clips, 1)
        check_range("seeds", self.seeds, 1, 1000)
        if "boxes" not in read_specification(self.specification).truth:
            raise ConfigError(f'{self.specification} makes no boxes; add truth = ["boxes"]')
        for arm in self.arms:
            if arm not in self.variants:
                raise ConfigError(f"unknown arm {shown(arm)}; {suggest(arm, self.variants)}")

    @property
    def variants(self) -> tuple[str, ...]:
        """All arms."""
        return tuple(one.name for one in read_specification(self.specification).variants)

    def training(self, arm: str, seed: int) -> DetectionConfig:
        """Training of the network of an arm and seed."""
        data = DetectionData(folder=self.work / "rvt" / arm, passes=self.passes)
        return DetectionConfig(seed=seed, data=data, schedule=self.schedule)


def run_detection(
    plan: DetectionPlan,
    hardware: Hardware,
    *,
    jobs: int = 1,
    progress: Progress = no_progress,
) -> DetectionReport:
    """Make, train and test what was not before.

    Args:
        plan: see `DetectionPlan`.
        hardware: what trains.
        jobs: processes that make clips; as many arms are trained at once.
        progress: told of every step.

    Raises:
        ConfigError, InputError, TexventError: a step cannot be done.
    """
    start = time.perf_counter()
    arms = plan.arms or plan.variants
    make_clips(plan, arms, jobs=jobs, progress=progress)
    todo = [(plan, hardware, arm, seed) for seed in range(plan.seeds) for arm in arms]
    scores = []
    for score in run_jobs(train_and_test, todo, jobs):
        progress(f"{score.arm}, seed {score.seed}: AP50 {score.ap50['all']['value']:.3f}")
        scores.append(score)
    return DetectionReport(
        environment=describe_environment(),
        protocol=_protocol(plan, arms, hardware),
        scores=scores,
        seconds=time.perf_counter() - start,
    )


def make_clips(plan: DetectionPlan, arms: Sequence[str], *, jobs: int, progress: Progress) -> None:
    """Make the same clips in every arm, and export what RVT reads.

    Raises:
        InputError: a shard is not what was made.
        TexventError: a clip could not be made.
    """
    folder, whole = plan.work / "clips", read_specification(plan.specification)
    work = dataset.make(with_count(whole, plan.clips), folder, workers=jobs)
    if work.failures:
        raise TexventError(f"clips could not be made: {next(iter(work.failures.values()))}")
    stored = StoredDataset.open(folder)
    changed = verify(stored, workers=jobs, contents=False).changed
    if changed:
        raise InputError(f"{folder}: {changed[0]}; delete that shard, and it is made again")
    for arm in arms:
        done = export(stored, "rvt", plan.work / "rvt" / arm, variant=arm, classes=CLASSES)
        progress(f"{arm}: {done.samples} clips")


def train_and_test(plan: DetectionPlan, hardware: Hardware, arm: str, seed: int) -> ArmScore:
    """Train a network, or go on, and score its best epoch; the scores are kept beside it."""
    folder = plan.work / "networks" / f"{arm}-{seed}"
    config, started = plan.training(arm, seed), time.perf_counter()
    task, tables = config.make_task(), plain(config)
    state = train(
        task, plan.schedule, folder, tables=tables, hardware=hardware, progress=NO_PROGRESS
    )
    facts = _facts_of_score(state, Path(config.data.folder or ""))
    kept = _read_score(folder / SCORES_FILE, facts)
    if kept is not None:
        return kept
    network, device = task.make_network(), hardware.find_device()
    network.load_state_dict(state.best)
    network.to(device).eval()
    with hardware.autocast(device):
        score = score_network(network, config, device, arm)
    score = dataclasses.replace(
        score,
        best_epoch=state.best_epoch,
        training_seconds=sum(row["seconds"] for row in state.rows),
        seconds=time.perf_counter() - started,
    )
    with atomic_file(folder / SCORES_FILE, overwrite=True) as part:
        content = {"of": facts, "score": asdict(score)}
        part.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    return score


def _facts_of_score(state: TrainingState, clips: Path) -> dict[str, Any]:
    """A score depends on a training, on the clips of its arm, and on whether there is a street."""
    made_of = Ledger(clips / LEDGER_FILE, remedy="delete it, and the clips are exported again")
    facts = {
        "texvent_version": state.version,
        "training": state.tables,
        "epochs": state.epochs,
        "clips": digest([[place, made_of.row(place)["of"]] for place in sorted(made_of)]),
        "street": find_pulled(STREET) is not None,
    }
    return dict(json.loads(json.dumps(facts)))


def _read_score(path: Path, facts: Mapping[str, Any]) -> ArmScore | None:
    """The stored score of these facts; None: there is none, or it is damaged."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        return ArmScore(**content["score"]) if content["of"] == facts else None
    except (OSError, ValueError, TypeError, KeyError, RecursionError):
        return None


def score_network(network: Any, config: DetectionConfig, device: Any, arm: str) -> ArmScore:
    """AP of a network on the unseen clips of its arm, and on the street where it is pulled."""
    folder, binning = Path(config.data.folder or ""), config.data.binning
    classes = CLASSES.split(",")
    clips = read_clips(folder, "test", binning)
    found = scale(detect_clips(network, clips, device), binning)
    truth = scale(join_boxes([one.boxes for one in clips]), binning)
    events = [int(one.counts.sum()) for one in clips]
    block = min(MOST_WINDOWS, len(np.unique(truth["t"])))
    return ArmScore(
        arm=arm,
        seed=config.seed,
        clips={name: _count(folder / name) for name in ("train", "val", "test")},
        events=float(np.median(events)),
        boxes=int((truth["class_confidence"] > IGNORED).sum()),
        ap=average_precision(found, truth, classes=classes),
        ap50=_ends(
            bootstrap(found, truth, classes=classes, iou=AP50, block=block, samples=SAMPLES)
        ),
        ap50_by_size={
            name: average_precision(*_of_size(found, truth, limits), classes=classes, iou=AP50)[ALL]
            for name, limits in SIZES.items()
        },
        street=score_street(network, classes, device, binning),
    )


def _count(folder: Path) -> int:
    return sum(one.is_dir() for one in folder.iterdir())


def _of_size(
    found: NDArray[np.void], truth: NDArray[np.void], limits: tuple[float, float]
) -> tuple[NDArray[np.void], NDArray[np.void]]:
    """Detections of that area, and boxes of which others than those of that area do not count."""
    low, high = limits
    has_size = [
        (low <= area) & (area < high) for area in (one["w"] * one["h"] for one in (found, truth))
    ]
    marked = truth.copy()
    marked["class_confidence"][~has_size[1]] = IGNORED
    return found[has_size[0]], marked


def score_street(
    network: Any, classes: Sequence[str], device: Any, binning: int
) -> Mapping[str, Mapping[str, float]] | None:
    """AP50 and AP of cars on the recorded street, with 95 % intervals; None if it is not pulled."""
    path = find_pulled(STREET)
    if path is None:
        return None
    truth = read_street_labels(classes)
    detections = _detect_street(network, path, np.unique(truth["t"]), device, binning)
    found = scale(np.concatenate(list(detections)), binning)
    return {
        "AP50": _ends(bootstrap(found, truth, classes=classes, iou=AP50))["car"],
        "AP": _ends(bootstrap(found, truth, classes=classes))["car"],
    }


def _ends(scores: Mapping[str, PrecisionEstimate]) -> dict[str, dict[str, float]]:
    ends = ("value", "low", "high")
    return {name: {end: getattr(one, end) for end in ends} for name, one in scores.items()}


def _detect_street(
    network: Any, path: Path, instants_us: NDArray[np.int64], device: Any, binning: int
) -> Iterator[NDArray[np.void]]:
    """Detections at each instant, after the windows before it, in cells."""
    events = open_events(path).collect()
    for t_us in map(int, instants_us):
        count = min(MOST_WINDOWS, max(1, (t_us - int(events.t[0])) // WINDOW_US))
        ends = [t_us - WINDOW_US * number for number in reversed(range(count))]
        windows = [
            bin_pixels(stacked_histogram(events.cut(end - WINDOW_US, end + 1)), binning)
            for end in ends
        ]
        yield as_boxes(detect_last(network, windows, device), t_us, windows[0].shape[1:])


def _protocol(plan: DetectionPlan, arms: Sequence[str], hardware: Hardware) -> dict[str, Any]:
    cuda = require("torch", extra=EXTRA).cuda
    options = {one.name: one.options for one in read_specification(plan.specification).variants}
    return {
        "network": "RVT-T of evlib, YOLOX head, from random weights",
        "schedule": plain(plan.schedule),
        "precision": hardware.precision,
        "gpu": cuda.get_device_name() if hardware.find_device().type == "cuda" else None,
        "clips": plain(DetectionData(passes=plan.passes)),
        "arms": {arm: dict(options[arm]) for arm in arms},
        "boxes at rest": "ignored",
    }
