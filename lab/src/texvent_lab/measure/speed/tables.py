"""The measured figures as Markdown tables.

python -m texvent_lab.measure.speed.tables docs/results/speed.json.gz
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from texvent_lab.bench.document import read_document
from texvent_lab.measure.speed.stages import STAGES
from texvent_lab.measure.speed.timing import rounded

Document = dict[str, Any]
PAPER, MULTI = "texvent", "esim"


class Target(NamedTuple):
    """A limit and how to read the figure from the document; None where it was not measured."""

    name: str
    limit: float
    at_least: bool
    read: Callable[[Document], float | None]


def _kernel(document: Document, model: str, density: float, way: str = "clip") -> Document:
    rows: Iterator[Document] = (
        row
        for row in document["kernels"]
        if (row["model"], row["size"], row["density"], row["way"])
        == (model, "1280x720", density, way)
    )
    return next(rows)


def _two_over_one(document: Document, way: str, *densities: float) -> float:
    """Least throughput of two threads over that of one."""
    return min(
        float(
            _kernel(document, PAPER, density)["ms_per_frame"]["median"]
            / _kernel(document, PAPER, density, way)["ms_per_frame"]["median"]
        )
        for density in densities
    )


def _ratio(document: Document, clip: str, ours: str) -> float | None:
    for row in document["peers"]:
        if (row["clip"], row["ours"]["name"]) == (clip, ours):
            ratio: float | None = row["ratio_to_fastest_peer"]
            return ratio
    return None


TARGETS = (
    Target(
        "720p, paper preset, 0.1 % firing: time over the floor",
        3.5,
        False,
        lambda one: float(_kernel(one, PAPER, 0.001)["times_floor"]),
    ),
    Target(
        "720p, paper preset, 20 % firing: Mevents/s",
        100.0,
        True,
        lambda one: float(_kernel(one, PAPER, 0.2)["mevents_per_s"]),
    ),
    Target(
        "720p, multi-crossing (esim), 20 % firing: Mevents/s",
        60.0,
        True,
        lambda one: float(_kernel(one, MULTI, 0.2)["mevents_per_s"]),
    ),
    Target(
        "720p, paper preset, two clips in parallel at 5 %: throughput over one",
        1.9,
        True,
        lambda one: _two_over_one(one, "clips", 0.05),
    ),
    Target(
        "heavy clip, paper preset: time of the fastest peer over ours",
        5.0,
        True,
        lambda one: _ratio(one, "heavy", "texvent, paper preset"),
    ),
    Target(
        "heavy clip, esim: time of the fastest peer over ours",
        5.0,
        True,
        lambda one: _ratio(one, "heavy", "texvent, esim"),
    ),
    Target(
        "real video at 200 fps, paper preset: time of the fastest peer over ours",
        20.0,
        True,
        lambda one: _ratio(one, "real video, 200 fps", "texvent, paper preset"),
    ),
    Target(
        "real video at 200 fps, esim: time of the fastest peer over ours",
        20.0,
        True,
        lambda one: _ratio(one, "real video, 200 fps", "texvent, esim"),
    ),
    Target(
        "heavy clip with motion compensation: eventcv's adaptive mode, as many events, over ours",
        10.0,
        True,
        lambda one: _ratio(one, "heavy", "texvent, paper preset, with flow"),
    ),
    Target(
        "heavy clip with motion compensation: eventcv as shipped (adaptive) over ours",
        10.0,
        True,
        lambda one: _ratio(one, "heavy, as shipped", "texvent, paper preset, with flow"),
    ),
    Target(
        "texvent --help, CPU seconds",
        0.3,
        False,
        lambda one: float(one["startup"]["help_cpu_s"]["median"]),
    ),
    Target(
        "two-second clip, warm cache: seconds from launch to the first events in the file",
        3.0,
        False,
        lambda one: float(one["startup"]["first_events_s"]["median"]),
    ),
)


def check_targets(document: Document) -> list[Document]:
    """A row per target: its limit, the figure, and whether it is met (None: not measured)."""
    rows = []
    for target in TARGETS:
        value = target.read(document)
        is_met = None
        if value is not None:
            is_met = value >= target.limit if target.at_least else value <= target.limit
        rows.append(
            {
                "name": target.name,
                "wanted": f"{'at least' if target.at_least else 'at most'} {target.limit:g}",
                "value": None if value is None else rounded(value),
                "is_met": is_met,
            }
        )
    return rows


def as_markdown(document: Document) -> str:
    """All tables of a document."""
    return "\n\n".join(
        (
            _conditions(document),
            _targets(document),
            _kernels(document),
            _pipeline(document),
            _peers(document),
            _startup(document),
            _gpu(document),
        )
    )


def _table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def _spread(quartiles: Document) -> str:
    """Median and quartiles: `1.2 (1.1-1.4)`."""
    return f"{quartiles['median']:g} ({quartiles['q1']:g}-{quartiles['q3']:g})"


def _conditions(document: Document) -> str:
    facts, bandwidth = document["environment"], document["bandwidth"]
    read = "; ".join(
        f"{threads} thread{'s' if threads != '1' else ''} {one['dram_gb_s']:g} from DRAM, "
        f"{one['cache_gb_s']:g} from cache"
        for threads, one in bandwidth.items()
    )
    packages = ", ".join(f"{name} {version}" for name, version in facts["packages"].items())
    return (
        f"Commit {facts['commit'][:12]}, texvent {facts['texvent_version']}, Python "
        f"{facts['python']}, {packages}; {facts['device']}, {facts['system']}; load of the machine "
        f"{document['load_at_start']:g} before and {document['load_at_end']:g} after. "
        f"Read bandwidth, GB/s: {read}. Medians, with quartiles in brackets."
    )


def _targets(document: Document) -> str:
    words = {True: "met", False: "missed", None: "not measured"}
    rows = [
        (one["name"], one["wanted"], "-" if one["value"] is None else one["value"],
         words[one["is_met"]])
        for one in document["targets"]
    ]  # fmt: skip
    return "### Targets\n\n" + _table(("figure", "wanted", "measured", ""), rows)


def _kernels(document: Document) -> str:
    rows = [
        (
            row["model"], row["size"], f"{row['density']:.1%}", row["way"],
            f"{row['events_per_frame']:,.0f}", _spread(row["ms_per_frame"]),
            row["mpixel_per_s"], row["mevents_per_s"], row["floor_ms"], row["times_floor"],
        )
        for row in document["kernels"]
    ]  # fmt: skip
    head = ("model", "size", "jumping", "way", "events", "ms per frame", "Mpixel/s",
            "Mevents/s", "floor, ms", "times floor")  # fmt: skip
    return "### Kernels\n\n" + _table(head, rows)


def _pipeline(document: Document) -> str:
    rows = [
        (
            row["clip"], row["size"], row["interpolate"], row["engine"],
            *(f"{row['stages_ms'][stage]['median']:g}" for stage in STAGES),
            _spread(row["alone_ms"]), row.get("overlapped_ms", "-"),
            row.get("gain_by_overlap", "-"),
        )
        for row in document["pipeline"]
    ]  # fmt: skip
    head = ("clip", "size", "interpolate", "engine", *STAGES, "sum", "overlapped", "gain")
    return "### Pipeline, ms per pair of source frames\n\n" + _table(head, rows)


def _peers(document: Document) -> str:
    rows = []
    for row in document["peers"]:
        ours = row["ours"]
        rows.append(
            (row["clip"], row["size"], f"**{ours['name']}**", ours["threshold"],
             f"{ours['events_per_pair']:,.0f}", _spread(ours["ms_per_pair"]), "")
        )  # fmt: skip
        rows += [_peer_row(peer, ours) for peer in row["peers"]]
    head = ("clip", "size", "program", "threshold", "events per pair", "ms per pair", "over ours")
    return "### Peers, one core\n\n" + _table(head, rows)


def _peer_row(peer: Document, ours: Document) -> tuple[Any, ...]:
    name = f"{peer['name']} {peer['version'] or ''}".strip()
    if not peer["installed"]:
        return "", "", name, "", "", peer["problem"], ""
    over = peer["ms_per_pair"]["median"] / ours["ms_per_pair"]["median"]
    events = f"{peer['events_per_pair']:,.0f}"
    return "", "", name, peer["threshold"], events, _spread(peer["ms_per_pair"]), f"{over:.3g}"


def _startup(document: Document) -> str:
    names = {
        "help_cpu_s": "`texvent --help`, CPU",
        "generate_help_cpu_s": "`texvent generate --help`, CPU",
        "simulate_help_cpu_s": "`texvent simulate --help`, CPU",
        "first_events_s": "`texvent simulate` of a 2 s clip (640x360, heavy motion): first events",
        "cold_first_events_s": "the same with no compiled kernel in the cache",
    }
    startup = document["startup"]
    rows = [
        (text, _spread(startup[name]) if isinstance(startup[name], dict) else startup[name])
        for name, text in names.items()
    ]
    return "### Start-up, s\n\n" + _table(("what", "s"), rows)


def _gpu(document: Document) -> str:
    gpu = document["gpu"]
    if not gpu["available"]:
        return f"### GPU\n\n{gpu['note']}."
    copy = f"Copy bandwidth {_spread(gpu['copy_gb_per_s'])} GB/s; {gpu['environment']['device']}."
    kernels = [
        (
            row["model"], row["pixels"], f"{row['density']:.1%}", row["batch"],
            f"{row['events_per_frame']:,.0f}", _spread(row["us_per_frame"]), row["share_of_copy"],
        )
        for row in gpu["simulation"]
    ]  # fmt: skip
    head = ("model", "pixels", "jumping", "clips", "events", "us per frame", "share of copy")
    pairs = [
        (row["size"], row["precision"], _spread(row["ms_per_pair"]), row["peak_mib"])
        for row in gpu["rife_pairs"]
    ]
    rife = _table(("RIFE and simulation", "precision", "ms per pair", "peak, MiB"), pairs)
    return "\n\n".join(("### GPU", copy, _table(head, kernels), rife))


def main() -> None:
    """Print the tables of a document."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", type=Path)
    print(as_markdown(read_document(parser.parse_args().json)))


if __name__ == "__main__":
    main()
