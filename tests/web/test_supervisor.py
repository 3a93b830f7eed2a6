from __future__ import annotations

import sys
import time
from pathlib import Path

import pytest

from texvent.errors import InputError
from texvent.web import supervisor
from texvent.web.job import SimulateJob
from texvent.web.supervisor import Supervisor

SCENE = {"generator": "procedural", "duration": 0.1, "sensor": "24x18"}


def be_worker(monkeypatch: pytest.MonkeyPatch, program: str) -> None:
    monkeypatch.setattr(supervisor, "WORKER", (sys.executable, "-c", program))


def job(folder: Path, prompt: str = "a ball bounces") -> SimulateJob:
    return SimulateJob(folder=str(folder), prompt=prompt, options=SCENE)


def test_a_job_is_done_in_a_process_of_its_own(tmp_path: Path) -> None:
    answers = list(Supervisor(time_limit_s=120).run(job(tmp_path)))
    assert answers[-1].kind == "done"
    assert {answer.kind for answer in answers[:-1]} == {"progress"}
    assert Path(answers[-1].files["video"]).exists()


def test_a_refusal_reaches_the_visitor_in_its_own_words(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the prompt is empty"):
        list(Supervisor(time_limit_s=120).run(job(tmp_path, " ")))


@pytest.mark.parametrize("program", ["import os; os.abort()", "import sys; sys.exit(3)"])
def test_a_crash_is_one_error_and_not_ours(tmp_path: Path, monkeypatch, program: str) -> None:
    be_worker(monkeypatch, program)
    with pytest.raises(InputError, match="the job crashed"):
        list(Supervisor(time_limit_s=60).run(job(tmp_path)))


def test_an_endless_job_is_stopped(tmp_path: Path, monkeypatch) -> None:
    be_worker(monkeypatch, "import time; time.sleep(100)")
    began = time.monotonic()
    with pytest.raises(InputError, match="longer than 1 s and was stopped"):
        list(Supervisor(time_limit_s=1).run(job(tmp_path)))
    assert time.monotonic() - began < 90


def test_closing_the_answers_ends_the_worker(tmp_path: Path, monkeypatch) -> None:
    mark = tmp_path / "alive"
    be_worker(
        monkeypatch,
        "import time, pathlib\n"
        'print(\'{"kind": "progress"}\', flush=True)\n'
        f"while True: pathlib.Path({str(mark)!r}).touch(); time.sleep(0.02)",
    )
    answers = Supervisor(time_limit_s=60).run(job(tmp_path))
    assert next(answers).kind == "progress"
    answers.close()
    mark.unlink(missing_ok=True)
    time.sleep(0.3)
    assert not mark.exists()


def test_closing_ends_every_worker_and_takes_no_other_job(tmp_path: Path, monkeypatch) -> None:
    be_worker(
        monkeypatch,
        'import time; print(\'{"kind": "progress"}\', flush=True); time.sleep(100)',
    )
    everything = Supervisor(time_limit_s=60)
    answers = everything.run(job(tmp_path))
    assert next(answers).kind == "progress"
    everything.close()
    with pytest.raises(InputError, match="the job crashed"):
        next(answers)
    with pytest.raises(InputError, match="takes no more jobs"):
        next(everything.run(job(tmp_path)))
