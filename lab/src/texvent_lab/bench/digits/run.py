"""Networks trained on simulated digits, tested on recorded ones: all steps, then the report."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from texvent.config import check_range
from texvent.extending import require
from texvent_lab.bench.digits.arms import Step, find_arm
from texvent_lab.bench.digits.networks import train_one
from texvent_lab.bench.digits.plan import DigitsPlan, Run, list_trainings
from texvent_lab.bench.digits.results import Collector, DigitsReport
from texvent_lab.bench.digits.simulation import fit_cell, fit_physical, open_run, simulate_cell
from texvent_lab.bench.jobs import Progress, no_progress, run_jobs
from texvent_lab.train.schedule import EXTRA


def run_digits(
    plan: DigitsPlan, *, jobs: int = 1, progress: Progress = no_progress
) -> DigitsReport:
    """Simulate, train and test what was not before; see `DigitsPlan`.

    Args:
        plan: what is covered.
        jobs: processes to use; 1 stays in this one.
        progress: told of every step.

    Raises:
        MissingDependencyError: torch is not installed.
        InputError, FileFormatError: the data is missing or damaged.
        ConfigError: jobs is below 1.
    """
    start = time.perf_counter()
    check_range("jobs", jobs, 1)
    require("torch", extra=EXTRA)
    run = open_run(plan)

    def make(
        function: Callable[[Run, Any], str], step_of: Callable[[Any], Step], what: Sequence[Any]
    ) -> None:
        missing = [one for one in what if not step_of(one).is_done]
        done = run_jobs(function, [(run, one) for one in missing], jobs)
        for number, line in enumerate(done, start=1):
            progress(f"{number} of {len(missing)}  {line}")

    is_fitted = [name for name in plan.arms if find_arm(name).is_fitted]
    make(fit_physical, lambda _: run.pair_fit_step(), is_fitted[:1])
    fits = {run.fit_step(cell).digest: cell for cell in plan.cells if cell.choice == "matched"}
    make(fit_cell, run.fit_step, list(fits.values()))
    make(simulate_cell, run.set_step, plan.cells)
    make(train_one, run.training_step, list_trainings(plan))
    return Collector(run).report(time.perf_counter() - start)
