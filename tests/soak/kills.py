"""Kill runs at random moments, take them up again, and look for what was lost.

    python -m tests.soak.kills            # 200 kills: minutes
    python -m tests.soak.kills --kills 20

Each round starts `simulate`, `generate`, `convert` or `batch` in a folder, sends SIGKILL, SIGTERM
or SIGINT after a random time, and then runs the same command to its end. Afterwards every file must
be as an undisturbed run makes it: nothing half-written, nothing lost, nothing twice, no
hidden file left. It prints a table and ends with 1 if a round failed.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import numpy as np

COMMAND = [sys.executable, "-m", "texvent.cli.app"]
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
SMALL = ("--sensor", "64x48", "--previews", "png,html", "--noise", "none")
RUNS: Mapping[str, tuple[str, ...]] = {
    "simulate": ("simulate", "in/clip.npy", "--fps", "240", "-o", "out/a.h5", "--overwrite",
                 *SMALL),
    "several": ("simulate", "in/clip.npy", "--fps", "240", "-o", "out/a.raw", "-o", "out/a.csv",
                "--overwrite", "--interpolate", "none", *SMALL),
    "generate": ("generate", "a red car drives left", "-o", "out/a.h5", "--duration", "0.5",
                 "--overwrite", *SMALL),
    "convert": ("convert", "in/events.h5", "out/a.aedat4", "--overwrite"),
    "batch": ("batch", "in/prompts.txt", "-o", "out", "--duration", "0.2", *SMALL),
    "batch 2 jobs": ("batch", "in/prompts.txt", "-o", "out", "--duration", "0.2", "--jobs", "2",
                     *SMALL),
}  # fmt: skip


def make_inputs(folder: Path) -> None:
    """A clip of 400 frames, its events, and a list of prompts."""
    folder.mkdir()
    texture = np.random.default_rng(0).integers(60, 200, (48, 600), np.uint8)
    clip = np.stack([np.roll(texture, step, axis=1)[:, :64] for step in range(400)])
    np.save(folder / "clip.npy", clip)
    prompts = [f"a red car drives left past {count} trees" for count in range(2, 7)]
    (folder / "prompts.txt").write_text("\n".join(prompts))
    words = ["simulate", "clip.npy", "--fps", "240", "--previews", "none", "-o", "events.h5"]
    subprocess.run([*COMMAND, *words], cwd=folder, check=True, capture_output=True)


def contents(folder: Path) -> dict[str, bytes]:
    """Every file below a folder, hidden ones too."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.suffix not in (".html", ".png", ".jsonl")
    }


def names(folder: Path) -> set[str]:
    """Names of all files below a folder."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def run_whole(words: tuple[str, ...], folder: Path) -> float:
    """Run a command to its end; returns how long it took, s."""
    started = time.perf_counter()
    done = subprocess.run([*COMMAND, *words], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)} failed: {done.stderr}")
    return time.perf_counter() - started


def run_killed(words: tuple[str, ...], folder: Path, after_s: float, number: signal.Signals) -> str:
    """Run a command and send a signal to it and its processes; returns what it said."""
    process = subprocess.Popen(
        [*COMMAND, *words],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    time.sleep(after_s)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, number)
    return process.communicate(timeout=120)[1]


def judge(folder: Path, before: Mapping[str, bytes], wanted: Mapping[str, bytes]) -> list[str]:
    """What is wrong after a kill: files that are neither those of before nor complete."""
    faults = []
    for name, data in contents(folder).items():
        part = Path(name).parts[0]
        if part.startswith(".texvent-"):
            continue
        if data not in (before.get(name), wanted.get(name)) and name != "batch.json":
            faults.append(f"half-written: {name}")
    faults += [f"lost: {name}" for name in before if not (folder / name).exists()]
    return faults


def attack(kind: str, scratch: Path, wanted: Path, seconds: float, chance: random.Random) -> str:
    """One round; returns what is wrong, or nothing."""
    words, out = RUNS[kind], scratch / "out"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    if chance.random() < 0.5 and not kind.startswith("batch"):
        shutil.copytree(wanted, out, dirs_exist_ok=True)  # the run replaces older files
    before, whole = contents(out), contents(wanted)
    number = chance.choice(SIGNALS)
    said = run_killed(words, scratch, chance.uniform(0.05, 1.05) * seconds, number)
    faults = ["traceback"] if "Traceback" in said else []
    hidden = [name for name in names(out) if name.startswith(".texvent-")]
    if hidden and number is not signal.SIGKILL:
        faults.append(f"left after {number.name}: {hidden[0]}")
    faults += judge(out, before, whole)
    run_whole(words, scratch)
    if contents(out) != whole:
        faults.append("other files after going on")
    if names(out) != names(wanted):
        faults.append(f"names: {sorted(names(out) ^ names(wanted))[:3]}")
    return "; ".join(f"{number.name}: {fault}" for fault in faults)


def main() -> int:
    """Run the attack; returns 1 if a round failed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    rounds, failed = Counter[str](), Counter[str]()
    with tempfile.TemporaryDirectory(prefix="texvent-kills-") as name:
        scratch, wanted = Path(name), Path(name) / "wanted"
        wanted.mkdir()
        make_inputs(scratch / "in")
        seconds = {}
        for kind, words in RUNS.items():
            (scratch / "out").mkdir()
            seconds[kind] = run_whole(words, scratch)
            shutil.move(scratch / "out", wanted / kind)
        for number in range(options.kills):
            kind = list(RUNS)[number % len(RUNS)]
            rounds[kind] += 1
            fault = attack(kind, scratch, wanted / kind, seconds[kind], chance)
            if fault:
                failed[kind] += 1
                print(f"{kind}, round {number}: {fault}", flush=True)  # noqa: T201
    for kind, done in rounds.items():
        print(f"{kind:14} {done:4} kills, {failed[kind]} failed")  # noqa: T201
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
