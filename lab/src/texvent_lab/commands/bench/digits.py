"""`texvent bench digits`: networks trained on simulated events, tested on recorded ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError
from texvent.runtime.files.cache_folder import cache_folder
from texvent_lab.bench.digits.plan import ABLATION, DigitsPlan
from texvent_lab.bench.digits.results import digits_table
from texvent_lab.bench.digits.run import run_digits
from texvent_lab.commands.bench.bench import ResultOptions

DESCRIPTION = """\
Small networks learn digits from simulated events of MNIST's test images and are tested on
recordings of a real sensor, N-MNIST. docs/digits.md explains the table. Needs ./lab[train].

--mnist is a folder with t10k-images-idx3-ubyte.gz and t10k-labels-idx1-ubyte.gz, from the MNIST
page of Y. LeCun, C. Cortes and C. Burges. --nmnist is the unpacked N-MNIST of G. Orchard et al.
(Train and Test).

Sets and predictions are kept in --work, so a run that was stopped goes on."""
QUICK: Mapping[str, Any] = {
    "arms": (
        "texvent accurate",
        "texvent paper",
        "physical",
        "esim",
        "v2e noisy",
        "frame difference",
    ),
    "ways": ("exact", "frames"),
    "folds": 5,
}
"""Plan of --quick."""
ABLATED: Mapping[str, Any] = {
    "arms": ("texvent accurate", *(arm.name for arm in ABLATION)),
    "ways": ("exact", "frames"),
    "folds": 5,
}
"""Plan of --ablation."""


@dataclass(frozen=True, kw_only=True)
class DigitsOptions:
    """Data, simulators and networks."""

    main_options: ClassVar[tuple[str, ...]] = (
        *(
            "mnist",
            "nmnist",
            "quick",
            "ablation",
            "arms",
            "ways",
            "work",
            "jobs",
            "out",
            "overwrite",
        ),
    )

    mnist: Path = REQUIRED
    """Folder of MNIST's test images and labels."""
    nmnist: Path = REQUIRED
    """N-MNIST's folder."""
    quick: bool = False
    """Six arms with true frames: minutes on two cores."""
    ablation: bool = False
    """Display, motion and noise as on the recordings for fitting, then one property changed at a
    time."""
    arms: str | None = None
    """Names of arms, separated by commas; default: all but those of --ablation."""
    ways: str | None = None
    """Frames of simulators, separated by commas: true ones, 1,020 per second (exact), 60 per second
    and what the pipeline interpolates (flow), or those alone (frames); default: all."""
    digits: int = 2000
    """Digits that are simulated for training."""
    seeds: int = 3
    """Networks per set and per fold of recordings."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """Number type of the networks' computation; bfloat16 is faster on processors that have it."""
    work: Path | None = None
    """Folder that keeps the results of steps; default: texvent's cache."""
    jobs: int = 2
    """Processes to use."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": DigitsOptions(), "output": ResultOptions()},
        prog="texvent bench digits",
        description=DESCRIPTION,
    )
    output.check()
    if options.quick and options.ablation:
        raise ConfigError("--quick and --ablation name other arms; give one of them")
    chosen = dict(QUICK if options.quick else ABLATED if options.ablation else {})
    for name in ("arms", "ways"):
        names = getattr(options, name)
        chosen |= {name: tuple(names.split(","))} if names else {}
    plan = DigitsPlan(
        mnist=options.mnist,
        nmnist=options.nmnist,
        work=options.work or cache_folder("digits"),
        digits=options.digits,
        seeds=options.seeds,
        precision=options.precision,
        **chosen,
    )
    report = run_digits(plan, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    write_out(digits_table(report))
