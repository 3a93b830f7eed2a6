"""`texvent bench fidelity`: simulators against the true events of exact scenes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent_lab.bench.fidelity.entries import choose_entries
from texvent_lab.bench.fidelity.event_files import FileEntry, named_folders
from texvent_lab.bench.fidelity.oracle_run import (
    FULL,
    FidelityPlan,
    clip_name,
    run_fidelity,
    write_frames,
)
from texvent_lab.bench.fidelity.table import fidelity_tables
from texvent_lab.commands.bench.bench import ResultOptions


@dataclass(frozen=True, kw_only=True)
class FidelityOptions:
    """Scenes and simulators."""

    outputs: ClassVar[tuple[str, ...]] = ("write_frames",)

    full: bool = False
    """Every scene, ideal and noisy pixels, eight seeds: an hour instead of minutes."""
    scenes: str | None = None
    """Names of scenes, separated by commas: mixed, slow, fast, translate, static, flicker, hdr,
    prompt-car, prompt-dog, prompt-bird; default: mixed,translate,fast,slow."""
    simulators: str | None = None
    """Names of simulators, separated by commas, a preset after a colon (physical:davis346);
    default: all that are registered, texvent:paper, and physical:calibrated, which knows the
    sensor that makes the true events."""
    interpolations: str | None = None
    """Names of interpolators, separated by commas; default: none,blend,flow,exact (the true
    frames). Others, such as rife, need their weights."""
    events: tuple[str, ...] = ()
    """NAME=FOLDER of one more row, of a program that simulated the frames of --write-frames: an
    event file per clip, named as its folder (mixed-7.h5); or a sub-folder of such files per
    contrast threshold (0.15, 0.2), of which that one is scored that fits the number of true
    events."""
    write_frames: Path | None = None
    """Write the frames that simulators get into this folder, for other programs, and end."""
    jobs: int = 2
    """Processes to use."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": FidelityOptions(), "output": ResultOptions()},
        prog="texvent bench fidelity",
        description="Simulators get a video of 24 frames per second in 8 bits, and are scored by "
        "the events that truly happened. docs/benchmark.md explains the tables.",
    )
    output.check()
    plan = FULL if options.full else FidelityPlan()
    if options.scenes:
        plan = replace(plan, scenes=tuple(options.scenes.split(",")))
    clips = [clip_name(*pair) for pair in plan.clips]
    if options.write_frames is not None:
        write_frames(plan, options.write_frames, overwrite=output.overwrite)
        write_out(
            f"{len(clips)} folders of frames in {options.write_frames}, 8 bits, 24 per second, "
            f"their times in timestamps.txt\nnext: simulate each into {clips[0]}.h5 and so on, "
            "times from 0, then texvent bench fidelity --events NAME=FOLDER\n"
        )
        return
    others = [FileEntry.find(*row, clips) for row in named_folders(options.events).items()]
    ours = choose_entries(options.simulators, options.interpolations)
    plan = replace(plan, entries=[*others, *ours])
    report = run_fidelity(plan, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    write_out(fidelity_tables(report))
