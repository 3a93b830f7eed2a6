"""Kill the making of a data set at random moments until it is whole, and compare every shard.

    python -m tests.soak.dataset_kills                      # 2,000 samples, 10 kills of each kind
    python -m tests.soak.dataset_kills --samples 400 --kills 3 --engines pool

One process makes the data set undisturbed. Then it is made again by three engines: processes of
this machine, a Ray cluster of two nodes (`ray.cluster_utils.Cluster`), and two `ray start`
programs. Meanwhile the driver, and a worker or a node, get SIGKILL at random moments; the driver is
started again, and the node comes back. In the end all shards must have the bytes of the
undisturbed run, no sample may be missing or there twice, and no hidden file may be left. It prints
a table and ends with 1 if something is wrong. The last two need the extra `ray`.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

COMMAND = [sys.executable, "-m", "texvent.cli.app", "dataset", "make"]
PAPER_SEEDS, ESIM_SEEDS = 15, 5
SPECIFICATION = f"""
name = "tiny"
samples_per_shard = 2
previews = false
filters = {{ min_events = 1 }}
[options]
fps = 120
interpolate = "none"
contrast_threshold = {{uniform = [0.1, 0.3]}}
[[sources]]
videos = ["clips/*.npy"]
[variants.paper]
seeds = {PAPER_SEEDS}
[variants.esim]
simulator = "esim"
seeds = {ESIM_SEEDS}
"""
NODE = {"num_cpus": 1, "object_store_memory": 100 * 2**20}
PATIENCE_S = 120.0


@dataclass
class Score:
    """What an engine went through."""

    drivers: int = 0
    others: int = 0
    """Workers or nodes killed."""
    runs: int = 0
    """Data sets made to their end."""
    faults: list[str] = field(default_factory=list)
    seconds: float = 0.0


@dataclass
class Attack:
    """What an engine needs to be attacked."""

    words: list[str]
    """Options of `texvent dataset make`."""
    kill_other: Callable[[int], bool]
    """Kill a worker or a node, given the driver's process id; False if there was none."""
    restore: Callable[[], None]
    """Bring back what was killed."""


def make_inputs(folder: Path, samples: int) -> Path:
    """Tiny clips and the specification of a data set of so many samples."""
    (folder / "clips").mkdir(parents=True)
    random_pixels = np.random.default_rng(0)
    for number in range(-(-samples // (PAPER_SEEDS + ESIM_SEEDS))):
        clip = random_pixels.integers(0, 255, (6, 12, 16), dtype=np.uint8)
        np.save(folder / "clips" / f"{number:05d}.npy", clip)
    path = folder / "tiny.toml"
    path.write_text(SPECIFICATION)
    return path


def digests(folder: Path) -> dict[str, str]:
    """Path of every shard → sha256 of its bytes."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*.tar"))
    }


def judge(folder: Path, wanted: Path) -> list[str]:
    """What is wrong with a data set that should be as another one."""
    faults, keys = [], Counter[str]()
    found, right = digests(folder), digests(wanted)
    faults += [f"other bytes: {name}" for name in right if found.get(name) != right[name]]
    faults += [f"more than asked for: {name}" for name in found.keys() - right.keys()]
    for name in found:
        record = (folder / name).with_suffix(".json")
        facts = json.loads(record.read_text()) if record.exists() else {"samples": []}
        if facts.get("sha256") != found[name]:
            faults.append(f"its record does not fit: {name}")
        keys.update(sample["key"] for sample in facts["samples"])
    faults += [f"{count} times: {key}" for key, count in keys.items() if count > 1]
    wanted_keys = {
        sample["key"]
        for path in wanted.rglob("*-0*.json")
        for sample in json.loads(path.read_text())["samples"]
    }
    faults += [f"missing: {key}" for key in wanted_keys - keys.keys()]
    faults += [f"left: {path.name}" for path in folder.rglob(".texvent-*")]
    return faults


def descendants(pid: int) -> list[int]:
    """Process ids below a process, from /proc."""
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            words = entry.read_text().rpartition(")")[2].split()
            if words[0] != "Z":
                children.setdefault(int(words[1]), []).append(int(entry.parent.name))
    found, todo = [], [pid]
    while todo:
        below = children.get(todo.pop(), [])
        found += below
        todo += below
    return found


def kill(pids: list[int]) -> None:
    """SIGKILL to each of some processes."""
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def wait_for_end(pids: list[int]) -> bool:
    """Wait until processes are gone; False if some stay."""
    ends = time.monotonic() + PATIENCE_S
    while time.monotonic() < ends:
        if not any(is_alive(pid) for pid in pids):
            return True
        time.sleep(0.05)
    return False


def is_alive(pid: int) -> bool:
    """True if a process runs; one that nobody has waited for does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def make_once(
    attack: Attack, words: list[str], chance: random.Random, pace_s: float, score: Score, kills: int
) -> str:
    """Start the driver, kill it or another process after a while; returns how it ended."""
    driver = subprocess.Popen(
        [*COMMAND, *words, *attack.words, "--quiet"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    while score.drivers < kills or score.others < kills:
        with contextlib.suppress(subprocess.TimeoutExpired):
            driver.wait(chance.uniform(0.05, 2.0) * pace_s)
        if driver.poll() is not None:
            break
        below = descendants(driver.pid)
        if chance.random() * (2 * kills - score.drivers - score.others) < kills - score.drivers:
            driver.kill()
            score.drivers += 1
            driver.communicate()
            if not wait_for_end(below):
                score.faults.append("processes outlive the driver")
            return "killed"
        if attack.kill_other(driver.pid):
            score.others += 1
            time.sleep(chance.uniform(0, 0.5) * pace_s)
            attack.restore()
    error = driver.communicate(timeout=1200)[1]
    if driver.returncode:
        score.faults.append(f"the run ended with {driver.returncode}: {error[-300:]}")
    return "done"


def attack_engine(
    attack: Attack,
    specification: Path,
    wanted: Path,
    *,
    kills: int,
    chance: random.Random,
    pace_s: float,
) -> Score:
    """Make data sets under attack until there were enough kills; the last one to its end."""
    score, started = Score(), time.monotonic()
    out = wanted.parent / "attacked"
    words = [str(specification), "-o", str(out)]
    while True:
        end = make_once(attack, words, chance, pace_s, score, kills)
        if end == "done":
            score.runs += 1
            score.faults += judge(out, wanted)
            shutil.rmtree(out)
            if score.faults or min(score.drivers, score.others) >= kills:
                score.seconds = time.monotonic() - started
                return score


@contextlib.contextmanager
def pool(chance: random.Random) -> Iterator[Attack]:
    """Two processes of this machine."""

    def kill_worker(driver: int) -> bool:
        # The tracker of resources is no worker.
        workers = [pid for pid in descendants(driver) if "spawn_main" in command_line(pid)]
        if workers:
            kill([chance.choice(workers)])
        return bool(workers)

    yield Attack(["--workers", "2"], kill_worker, lambda: None)


def command_line(pid: int) -> str:
    """How a process was started."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_text().replace("\0", " ")
    except OSError:
        return ""


@contextlib.contextmanager
def cluster(chance: random.Random) -> Iterator[Attack]:
    """Two Ray nodes that this process owns."""
    del chance
    from ray.cluster_utils import Cluster

    nodes = Cluster(initialize_head=True, head_node_args=NODE)
    second: list[Any] = [nodes.add_node(**NODE)]

    def remove(driver: int) -> bool:
        del driver
        nodes.remove_node(second.pop(), allow_graceful=False)
        return True

    try:
        yield Attack(
            ["--ray", nodes.address], remove, lambda: second.append(nodes.add_node(**NODE))
        )
    finally:
        nodes.shutdown()


@contextlib.contextmanager
def programs(chance: random.Random) -> Iterator[Attack]:
    """Two `ray start` programs; a node goes with all of its processes at once."""
    del chance
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{free.getsockname()[1]}"
    common = ["--num-cpus=1", f"--object-store-memory={NODE['object_store_memory']}", "--block"]
    ray = [sys.executable, "-m", "ray.scripts.scripts", "start", *common]

    def start(*words: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [*ray, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )

    def count_nodes() -> int:
        program = (
            "import ray, sys; ray.init(sys.argv[1], logging_level='ERROR', log_to_driver=False); "
            "print(sum(node['Alive'] for node in ray.nodes()))"
        )
        asked = subprocess.run(
            [sys.executable, "-c", program, address], capture_output=True, text=True, timeout=120
        )
        return int(asked.stdout.split()[-1]) if asked.returncode == 0 else 0

    def wait_for(count: int) -> None:
        ends = time.monotonic() + PATIENCE_S
        while count_nodes() < count:
            if time.monotonic() > ends:
                raise SystemExit("a Ray node does not start")

    def stop(node: subprocess.Popen[bytes]) -> None:
        kill([*descendants(node.pid), node.pid])
        node.wait()

    def remove(driver: int) -> bool:
        del driver
        stop(nodes.pop())
        return True

    def restore() -> None:
        nodes.append(start(f"--address={address}"))

    nodes = [start("--head", f"--port={address.rpartition(':')[2]}", "--include-dashboard=false")]
    try:
        wait_for(1)
        restore()
        wait_for(2)
        yield Attack(["--ray", address], remove, restore)
    finally:
        for node in reversed(nodes):
            stop(node)


ENGINES = {"pool": pool, "cluster": cluster, "programs": programs}


def main() -> int:
    """Run the attacks; returns 1 if something is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=2000)
    parser.add_argument("--kills", type=int, default=10, help="of the driver, and of the others")
    parser.add_argument("--engines", nargs="+", choices=ENGINES, default=list(ENGINES))
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    chance, faults = random.Random(options.seed), 0
    with tempfile.TemporaryDirectory(prefix="txv-", dir="/tmp") as name:
        os.environ.setdefault("RAY_TMPDIR", name)
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        os.environ["RAY_AUTH_MODE"] = "disabled"  # both nodes are on this machine
        specification = make_inputs(Path(name), options.samples)
        wanted, started = Path(name) / "wanted", time.monotonic()
        whole = [*COMMAND, str(specification), "-o", str(wanted), "--workers", "1", "-q"]
        subprocess.run(whole, check=True)
        seconds = time.monotonic() - started
        shards = len(digests(wanted))
        say(f"one process: {options.samples} samples in {shards} shards, {seconds:.0f} s")
        for engine in options.engines:
            with ENGINES[engine](chance) as attack:
                score = attack_engine(
                    attack,
                    specification,
                    wanted,
                    kills=options.kills,
                    chance=chance,
                    pace_s=max(3.0, seconds / options.kills / 2),
                )
            faults += len(score.faults)
            say(
                f"{engine:9} {score.drivers:3} drivers and {score.others:3} "
                f"{'workers' if engine == 'pool' else 'nodes'} killed, {score.runs} data sets "
                f"whole, {len(score.faults)} faults, {score.seconds:.0f} s"
            )
            for fault in score.faults[:5]:
                say(f"  {fault}")
    return 1 if faults else 0


def say(line: str) -> None:
    """Print a line at once."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
