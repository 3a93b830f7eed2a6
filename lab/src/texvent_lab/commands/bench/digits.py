"""`texvent bench digits`: networks trained on simulated events, tested on recorded ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.io.atomic import atomic_file
from texvent.runtime.cache_folder import cache_folder
from texvent_lab.bench.digits.arms import ARMS
from texvent_lab.bench.digits.page import page_files, page_paths
from texvent_lab.bench.digits.plan import DigitsPlan
from texvent_lab.bench.digits.run import run_digits
from texvent_lab.bench.digits.tables import summary_text
from texvent_lab.commands.bench.bench import ResultOptions

DESCRIPTION = """\
Small networks learn digits from simulated events of MNIST's test images and are tested on
recordings of a real sensor, N-MNIST. docs/digits.md explains the tables. Needs texvent-lab[train].

--mnist is a folder with t10k-images-idx3-ubyte.gz and t10k-labels-idx1-ubyte.gz, from the MNIST
page of Y. LeCun, C. Cortes and C. Burges. --nmnist is the unpacked N-MNIST of G. Orchard et al.
(Train and Test), or a folder or .zip file with NUMBER.bin files and labels.csv.

Every step is kept in --work, so a run that was stopped goes on."""
QUICK: Mapping[str, Any] = {
    "arms": (
        "texvent accurate",
        "texvent paper",
        "physical",
        "esim",
        "v2e noisy",
        "frame difference",
    ),
    "ways": ("exact",),
    "choices": ("matched",),
    "digits": 2000,
    "held_out": 200,
    "seeds": 3,
    "other_seeds": 1,
    "folds": 5,
    "shots": (),
}
"""What --quick covers."""


@dataclass(frozen=True, kw_only=True)
class DigitsOptions:
    """What to run."""

    main_options: ClassVar[tuple[str, ...]] = (
        "mnist", "nmnist", "quick", "arms", "choices", "ways", "digits", "seeds", "jobs", "out",
        "overwrite",
    )  # fmt: skip

    mnist: Path = REQUIRED
    """Folder of MNIST's test images and labels."""
    nmnist: Path = REQUIRED
    """N-MNIST's folder, or a folder or .zip file with NUMBER.bin files and labels.csv."""
    quick: bool = False
    """Six arms and three networks each: minutes on two cores."""
    arms: str | None = None
    """Names of arms, separated by commas; default: all."""
    choices: str = "matched,default,random"
    """How thresholds are chosen: fitted to the counts of pairs, the presets' own, drawn per sheet
    of digits."""
    ways: str = "exact,flow"
    """What simulators get: true frames, 1,020 per second (exact), or 60 per second and what the
    pipeline interpolates (flow)."""
    digits: int = 2000
    """Digits that are simulated for training."""
    seeds: int = 3
    """Networks per set with matched thresholds."""
    other_seeds: int = 2
    """Networks per set with other thresholds, and per fold of recordings."""
    few_shot: bool = True
    """Also train on 1, 3, 10 and 30 recordings per class, with simulated ones and without."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """Number type of the networks' computation; bfloat16 is faster on processors that have it."""
    work: Path | None = None
    """Folder that keeps the results of steps; default: texvent's cache."""
    jobs: int = 2
    """Processes to use."""

    def plan_options(self) -> dict[str, Any]:
        """What these options ask for; `DigitsPlan` takes them."""
        if self.quick:
            return dict(QUICK)
        return {
            "arms": tuple(self.arms.split(",")) if self.arms else tuple(one.name for one in ARMS),
            "choices": tuple(self.choices.split(",")),
            "ways": tuple(self.ways.split(",")),
            "digits": self.digits,
            "seeds": self.seeds,
            "other_seeds": self.other_seeds,
            **({} if self.few_shot else {"shots": ()}),
        }


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": DigitsOptions(), "output": ResultOptions()},
        prog="texvent bench digits",
        description=DESCRIPTION,
    )
    work = options.work or cache_folder("digits")
    plan = DigitsPlan(
        mnist=options.mnist,
        nmnist=options.nmnist,
        work=work,
        precision=options.precision,
        **options.plan_options(),
    )
    output.check(*page_paths(output.out))
    report = run_digits(plan, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    if output.out is not None:
        for name, content in page_files(report, output.out.name).items():
            with atomic_file(output.out.parent / name, overwrite=output.overwrite) as part:
                part.write_bytes(content)
    write_out(summary_text(report))
