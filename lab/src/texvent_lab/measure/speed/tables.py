"""The measured figures as Markdown tables."""

from __future__ import annotations

from typing import Any

from texvent_lab.bench.document import markdown_table

Document = dict[str, Any]
CORE, WITH_FLOW = 2.0, 0.25
"""Least ratios of a peer's time over ours."""


def as_markdown(document: Document) -> str:
    """All tables of a document."""
    parts = [_conditions(document), _kernels(document), _peers(document)]
    if "definition" in document:
        parts.append(_bounds(document))
    if not document["quick"]:
        parts += [_runs(document), _steps(document), _commands(document)]
    return "\n".join(parts)


def _spread(quartiles: Document) -> str:
    """Median and quartiles: `1.2 (1.1-1.4)`."""
    return f"{quartiles['median']:g} ({quartiles['q1']:g}-{quartiles['q3']:g})"


def _conditions(document: Document) -> str:
    facts = document["environment"]
    packages = ", ".join(f"{name} {version}" for name, version in facts["packages"].items())
    return (
        f"Commit {facts['commit'][:12]}, texvent {facts['texvent_version']}, Python "
        f"{facts['python']}, {packages}; {facts['device']}, {facts['system']}; load of the machine "
        f"{document['load_at_start']:g} before and {document['load_at_end']:g} after. Medians, "
        "with quartiles in brackets.\n"
    )


def _kernels(document: Document) -> str:
    rows = [
        (
            row["model"], row["size"], f"{row['density']:.1%}", row["way"],
            f"{row['events_per_frame']:,.0f}", _spread(row["ms_per_frame"]),
            f"{row['mpixel_per_s']:g}", f"{row['mevents_per_s']:g}",
        )
        for row in document["kernels"]
    ]  # fmt: skip
    head = ("model", "size", "jumping", "way", "events", "ms per frame", "Mpixel/s", "Mevents/s")
    return f"## Kernels\n\n{markdown_table(head, rows)}"


def _runs(document: Document) -> str:
    rows = [
        (
            row["clip"], row["size"], row["interpolate"], f"{row['events_per_pair']:,.0f}",
            f"{row['ms_per_pair']:g}",
        )
        for row in document["runs"]
    ]  # fmt: skip
    head = ("clip", "size", "interpolate", "events", "ms")
    return f"## Runs, per pair of source frames\n\n{markdown_table(head, rows)}"


def _steps(document: Document) -> str:
    rows = [
        (
            row["model"], row["size"], f"{row['events_per_step']:,.0f}", f"{row['ms_median']:g}",
            f"{row['ms_p95']:g}",
        )
        for row in document["steps"]
    ]  # fmt: skip
    head = ("model", "size", "events", "ms, median", "ms, 95 %")
    return f"## Steps of `texvent.EventCamera`\n\n{markdown_table(head, rows)}"


def _commands(document: Document) -> str:
    rows = [
        (row["command"], f"{row['cpu_s']:g}", f"{row['clock_s']:g}") for row in document["commands"]
    ]
    head = ("command", "processor time, s", "clock, s")
    return f"## Whole commands\n\n{markdown_table(head, rows)}"


def _bounds(document: Document) -> str:
    """Ratios that hold on any machine, with room for noise; one that is missed is marked."""
    kernel = {
        row["model"]: row
        for row in document["kernels"]
        if (row["size"], row["density"], row["way"]) == ("346x260", 0.05, "clip")
    }
    rows = []

    def add(ratio: str, value: float, bound: float) -> None:
        rows.append((ratio, f"{value:.3g}", f"{bound:g}", "" if value >= bound else "**missed**"))

    kernel_ms = kernel["texvent"]["ms_per_frame"]["median"]
    add("Eq. 5 in NumPy over the kernel", document["definition"]["median"] / kernel_ms, 2.5)
    for model, bound in (("texvent", 22.0), ("esim", 30.0)):
        add(f"{model}, events per microsecond", kernel[model]["mevents_per_s"], bound)
    for row in document["peers"]:
        ours = row["ours"]
        bound = WITH_FLOW if "flow" in ours["name"] else CORE
        for peer in row["peers"]:
            if peer["installed"]:
                ratio = peer["ms_per_pair"]["median"] / ours["ms_per_pair"]["median"]
                add(f"{row['clip']}: {peer['name']} over {ours['name']}", ratio, bound)
    return f"## Bounds\n\n{markdown_table(('ratio', 'measured', 'at least', ''), rows)}"


def _peers(document: Document) -> str:
    rows = []
    for row in document["peers"]:
        ours = row["ours"]
        rows.append((row["clip"], row["size"], f"**{ours['name']}**", *_program(ours), ""))
        for peer in row["peers"]:
            name = f"{peer['name']} {peer['version'] or ''}".strip()
            if peer["installed"]:
                over = peer["ms_per_pair"]["median"] / ours["ms_per_pair"]["median"]
                rows.append(("", "", name, *_program(peer), f"{over:.3g}"))
            else:
                rows.append(("", "", name, "", "", peer["problem"], ""))
    head = ("clip", "size", "program", "threshold", "events per pair", "ms per pair", "over ours")
    return f"## Peers, one core\n\n{markdown_table(head, rows)}"


def _program(row: Document) -> tuple[str, str, str]:
    events = f"{row['events_per_pair']:,.0f}"
    return f"{row['threshold']:g}", events, _spread(row["ms_per_pair"])
