"""`texvent bench classify`: how many event streams does N-ImageNet's classifier recognise?"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar

from rich.console import Console

from texvent.bench.classification.classify import classify, list_samples
from texvent.bench.classification.resnet34 import ResNetClassifier
from texvent.bench.classification.resnet34_weights import read_resnet_weights
from texvent.bench.document import write_document
from texvent.bench.environment import describe_environment
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_options
from texvent.io.atomic import check_output

SCHEMA = "texvent-classify-1"


@dataclass(frozen=True, kw_only=True)
class ClassifyOptions:
    """What to classify, and by which network."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    folder: Path = REQUIRED
    """Folder with one sub-folder of event files per class, recorded (N-ImageNet) or simulated."""
    weights: Path = REQUIRED
    """Published classifier: ResNet34 on binary event images, of 1000 classes or of 100."""
    classes: Path | None = None
    """Text file with one class name per line in the network's order; without it, the sub-folders
    must be all classes, in order of their names."""
    seed: int = 0
    """Decides which 30,000 events of each file are taken."""
    out: Path | None = None
    """JSON file for the result."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the result."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    values = parse_options(
        arguments,
        {"options": ClassifyOptions()},
        prog="texvent bench classify",
        description="N-ImageNet's protocol: a random run of 30,000 events of each file, scaled to "
        "224x224, as a binary event image per polarity, through a published ResNet34. The paper's "
        "Table 9; docs/benchmark.md explains it.",
    )
    options = ClassifyOptions(**values)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    classifier = ResNetClassifier(read_resnet_weights(options.weights))
    samples = list_samples(options.folder, classifier.class_count, classes=options.classes)
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    found = classify(
        samples,
        classifier,
        seed=options.seed,
        progress=lambda line: console.print(line, style="dim"),
    )
    if options.out is not None:
        document = {
            "schema": SCHEMA,
            "environment": describe_environment(),
            "folder": str(options.folder),
            "weights": options.weights.name,
            "seed": options.seed,
            **asdict(found),
        }
        write_document(options.out, document, overwrite=options.overwrite)
    first, second = found.standard_errors
    sys.stdout.write(
        f"top-1 {found.top1:.4f} ± {first:.4f}, top-5 {found.top5:.4f} ± {second:.4f} "
        f"({found.count} streams, {classifier.class_count} classes)\n"
    )
