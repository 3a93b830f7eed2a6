"""Cut the power at random moments while runs write, and look for what was lost.

    python -m tests.soak.power_cuts            # 60 cuts: minutes; needs root and loop devices
    python -m tests.soak.power_cuts --cuts 5

The runs of `kills.py` write to an ext4 file system of their own, which is shut down in the middle
without flushing its journal: all that was not synced is gone, as after a power cut. After the file
system is mounted again every file must be the old one or complete; what a command had finished
must be there; and the same command then runs to its end.
"""

from __future__ import annotations

import argparse
import contextlib
import fcntl
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.soak.kills import (
    COMMAND,
    RUNS,
    contents,
    judge,
    make_inputs,
    names,
    repeat,
    run_undisturbed,
    run_whole,
)

DISK_BYTES = 256 * 2**20
SHUTDOWN = 0x8004587D
"""EXT4_IOC_SHUTDOWN, and ..."""
WITHOUT_FLUSH = 2
"""... EXT4_GOING_FLAGS_NOLOGFLUSH, of linux/ext4.h."""


def system(*words: str | Path) -> None:
    """Run a program of the system; ends the attack if that fails."""
    done = subprocess.run([*map(str, words)], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{words[0]} failed (root and loop devices are needed): {done.stderr}")


@contextmanager
def disk(image: Path, place: Path) -> Iterator[None]:
    """The file system of an image, mounted."""
    system("mount", "-o", "loop", image, place)
    try:
        yield
    finally:
        unmount(place)


def unmount(place: Path, patience_s: float = 30.0) -> None:
    """Unmount, once the killed processes have let go."""
    ends = time.monotonic() + patience_s
    while subprocess.run(["umount", str(place)], capture_output=True).returncode:
        if time.monotonic() > ends:
            raise SystemExit(f"{place} stays busy; unmount it by hand")
        time.sleep(0.2)


def cut_power(place: Path) -> None:
    """Shut the file system down; nothing that is not on the disk yet will get there."""
    descriptor = os.open(place, os.O_RDONLY)
    try:
        fcntl.ioctl(descriptor, SHUTDOWN, struct.pack("I", WITHOUT_FLUSH))
    finally:
        os.close(descriptor)


def run_until_cut(words: tuple[str, ...], place: Path, after_s: float) -> bool:
    """Run a command and cut the power; returns whether it had ended well before."""
    process = subprocess.Popen(
        [*COMMAND, *words],
        cwd=place,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    time.sleep(after_s)
    is_done = process.poll() == 0
    cut_power(place)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(timeout=120)
    return is_done


def attack(kind: str, image: Path, place: Path, wanted: Path, after_s: float, is_new: bool) -> str:
    """One round; returns what is wrong, or nothing."""
    words, out = RUNS[kind], place / "out"
    whole = contents(wanted)
    with disk(image, place):
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        if not is_new:
            shutil.copytree(wanted, out, dirs_exist_ok=True)  # the run replaces older files
        os.sync()
        before = contents(out)
        is_done = run_until_cut(words, place, after_s)
    with disk(image, place):
        faults = judge(out, before, whole)
        if is_done and contents(out) != whole:
            faults.append("lost what was finished")
        run_whole(words, place)
        if contents(out) != whole:
            faults.append("other files after going on")
        if names(out) != names(wanted):
            faults.append(f"names: {sorted(names(out) ^ names(wanted))[:3]}")
    return "; ".join(faults)


def main() -> int:
    """Run the attack; returns 1 if a round failed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cuts", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix="texvent-cuts-") as name:
        scratch = Path(name)
        image, place = scratch / "disk.ext4", scratch / "disk"
        with image.open("wb") as file:
            file.truncate(DISK_BYTES)
        system("mkfs.ext4", "-q", image)
        place.mkdir()
        with disk(image, place):
            make_inputs(place / "in")
            wanted, seconds = run_undisturbed(place, scratch / "wanted")

        def cut(kind: str) -> str:
            is_new = kind.startswith("batch") or chance.random() < 0.5
            after_s = chance.uniform(0.3, 1.2) * seconds[kind]
            return attack(kind, image, place, wanted[kind], after_s, is_new)

        return repeat(options.cuts, "cuts", cut)


if __name__ == "__main__":
    sys.exit(main())
