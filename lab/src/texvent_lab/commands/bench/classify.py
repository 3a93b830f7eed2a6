"""`texvent bench classify`: how many event streams does N-ImageNet's classifier recognise?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent_lab.bench.classification import (
    classify,
    list_samples,
    read_resnet,
)
from texvent_lab.bench.document import describe_environment
from texvent_lab.commands.bench.result_options import ResultOptions

SCHEMA = "texvent-classify-1"


@dataclass(frozen=True, kw_only=True)
class ClassifyOptions:
    """What to classify, and by which network."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder with one sub-folder of event files per class, recorded (N-ImageNet) or simulated."""
    weights: Path = REQUIRED
    """Published classifier: ResNet34 on binary event images, of 1000 classes or of 100."""
    classes: Path | None = None
    """Text file with one class name per line in the network's order; without it, the sub-folders
    must be all classes, in order of their names."""
    seed: int = 0
    """Decides which 30,000 events of each file are taken."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": ClassifyOptions(), "output": ResultOptions()},
        prog="texvent bench classify",
        description="N-ImageNet's protocol: a random run of 30,000 events of each file, scaled to "
        "224x224, as a binary event image per polarity, through a published ResNet34. The paper's "
        "Table 9; docs/benchmark.md explains it.",
    )
    output.check()
    classifier = read_resnet(options.weights)
    samples = list_samples(options.folder, classifier.class_count, classes=options.classes)
    found = classify(
        samples,
        classifier,
        seed=options.seed,
        progress=output.progress,
    )
    output.write(
        lambda: {
            "schema": SCHEMA,
            "environment": describe_environment(),
            "folder": str(options.folder),
            "weights": options.weights.name,
            "seed": options.seed,
            **asdict(found),
        }
    )
    first, second = found.standard_errors
    write_out(
        f"top-1 {found.top1:.4f} ± {first:.4f}, top-5 {found.top5:.4f} ± {second:.4f} "
        f"({found.count} streams, {classifier.class_count} classes)\n"
    )
