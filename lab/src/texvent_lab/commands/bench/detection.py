"""`texvent bench detection`: detectors trained on simulated events, tested on unseen ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.extending import require
from texvent_lab.commands.bench.bench import ResultOptions
from texvent_lab.train.schedule import Hardware

DESCRIPTION = """\
Detectors (evlib's RVT-T) learn road users from the events of each variant of a data set, and are
tested on unseen clips and on a recorded street (texvent data pull davis346).
Needs ./lab[detection].

  texvent bench detection traffic.toml --work w --clips 60 --epochs 4 -o d.json

Clips, networks and scores are kept in --work, so a run that was stopped goes on."""


@dataclass(frozen=True, kw_only=True)
class DetectionOptions:
    """Clips and networks."""

    positional: ClassVar[tuple[str, ...]] = ("specification",)
    main_options: ClassVar[tuple[str, ...]] = (
        *("work", "clips", "arms", "epochs", "jobs", "precision", "out", "overwrite"),
    )

    specification: Path = REQUIRED
    """Data set with boxes; each variant is an arm."""
    work: Path = REQUIRED
    """Folder that keeps the results of steps."""
    clips: int | None = None
    """Clips in all; default: as the specification says."""
    arms: str | None = None
    """Names of variants, separated by commas; default: all."""
    seeds: int = 1
    """Networks per arm."""
    epochs: int = 30
    """Scored and stored states of a training."""
    passes: int = 1
    """Passes over the training clips in an epoch."""
    batch_size: int = 4
    """Clips per step."""
    jobs: int = 1
    """Processes that make clips; as many networks are trained at once."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, hardware, output = parse_configs(
        arguments,
        {"options": DetectionOptions(), "hardware": Hardware(), "output": ResultOptions()},
        prog="texvent bench detection",
        description=DESCRIPTION,
    )
    output.check()
    from texvent_lab.bench.detection.config import EXTRA, SCHEDULE

    for module in ("torch", "torchvision", "evlib.models.rvt", "pycocotools"):
        require(module, extra=EXTRA)
    from texvent_lab.bench.detection.results import detection_table
    from texvent_lab.bench.detection.run import DetectionPlan, run_detection  # brings torch

    plan = DetectionPlan(
        specification=options.specification,
        work=options.work,
        clips=options.clips,
        arms=tuple(options.arms.split(",")) if options.arms else (),
        seeds=options.seeds,
        passes=options.passes,
        schedule=replace(SCHEDULE, epochs=options.epochs, batch_size=options.batch_size),
    )
    report = run_detection(plan, hardware, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    write_out(detection_table(report))
