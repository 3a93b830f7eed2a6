"""`texvent bench objects`: networks trained on simulated objects, tested on recorded ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.runtime.files.cache_folder import cache_folder
from texvent_lab.bench.fidelity.event_files import named_folders
from texvent_lab.commands.bench.bench import ResultOptions

DESCRIPTION = """\
Networks learn objects on a table and a turntable from each simulator's events of the same clips,
and are tested on recordings; see docs/objects.md. Needs ./lab[detection].

  texvent bench objects configs/objects --frames a.zip --turntables DVS128"""


@dataclass(frozen=True, kw_only=True)
class ObjectsOptions:
    """Clips, recordings and networks."""

    outputs: ClassVar[tuple[str, ...]] = ("write_frames",)
    positional: ClassVar[tuple[str, ...]] = ("configs",)
    main_options: ClassVar[tuple[str, ...]] = (
        *("frames", "turntables", "arms", "factors", "clips", "work", "jobs", "out", "overwrite"),
    )

    configs: Path = REQUIRED
    """Folder of table.toml and turntable.toml, whose variants are the arms."""
    frames: Path = REQUIRED
    """Labelled frames of the robot's arm: the folder Integral, or a zip of it."""
    turntables: Path = REQUIRED
    """Folder of the recordings DataSet2_*.aedat."""
    arms: str | None = None
    """Names of variants, separated by commas, each for the tests that have it; default: all."""
    factors: Path | None = None
    """File of arms that differ from one of those in a single property, in place of them."""
    clips: int | None = None
    """Clips of each test; default: as the specifications say."""
    steps: int = 600
    """Batches of every training."""
    seeds: int = 3
    """Networks per arm and test."""
    spread: float = 0.0
    """Standard deviation of the logarithm of the contrast threshold between clips."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """Number type of the networks' computation; the second takes half the time on many
    processors."""
    events: tuple[str, ...] = ()
    """NAME=FOLDER of one more arm, of a program that simulated the frames of --write-frames: an
    event file per clip, named as it; or a sub-folder of such files per contrast threshold (0.15,
    0.2), of which the one is used that gives as many pixels an event as in the recordings."""
    write_frames: Path | None = None
    """Write the frames of each clip into a folder here, for other programs, and end."""
    work: Path | None = None
    """Folder that keeps the results of steps; default: texvent's cache."""
    jobs: int = 1
    """Processes to use."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": ObjectsOptions(), "output": ResultOptions()},
        prog="texvent bench objects",
        description=DESCRIPTION,
    )
    output.check()
    from texvent_lab.bench.objects.plan import ObjectsPlan
    from texvent_lab.bench.objects.results import objects_tables
    from texvent_lab.bench.objects.run import run_objects, write_frames

    plan = ObjectsPlan(
        configs=options.configs,
        frames=options.frames,
        turntables=options.turntables,
        work=options.work or cache_folder("objects"),
        arms=tuple(options.arms.split(",")) if options.arms else (),
        factors=options.factors,
        clips=options.clips,
        steps=options.steps,
        seeds=options.seeds,
        spread=options.spread,
        precision=options.precision,
        events=named_folders(options.events),
    )
    if options.write_frames is not None:
        write_frames(plan, options.write_frames, overwrite=output.overwrite)
        clips = list(plan.clip_names)
        write_out(
            f"{len(clips)} folders of frames in {options.write_frames}, 8 bits, their times in "
            f"timestamps.txt\nnext: simulate each into {clips[0]}.h5 and so on, times from 0, then "
            "texvent bench objects --events NAME=FOLDER\n"
        )
        return
    report = run_objects(plan, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    write_out(objects_tables(report))
