"""Plots of docs/results for the page site/figures.md: each once for light pages, once for dark."""

import gzip
import json
from collections.abc import Callable
from pathlib import Path
from statistics import mean, variance
from typing import Any

import matplotlib.pyplot as plt
from grating import grating
from matplotlib.axes import Axes
from matplotlib.figure import Figure

RESULTS = Path(__file__).parents[1] / "results"
SIMULATORS = ("physical", "texvent accurate", "esim", "voltmeter", "v2e", "texvent paper")
# Ink, faint ink, and colours that colour-blind readers can tell apart, for light and dark pages.
LOOKS = {
    "light": ("#1f2328", "#c8ccd0", ("#0b62a4", "#c2410c", "#3f7d20", "#6b7280", "#7c3aed")),
    "dark": ("#e6e8ea", "#464b52", ("#6cb2f0", "#fb9a5b", "#93cf6f", "#a3a9b3", "#c4a5ff")),
}
# Row → arms of objects-factors, digits-ablation and reconstruction-factors.
TEACHING = {
    "times of frames": ("frame times", "frame times", "frame times"),
    "no noise": ("no noise", "no noise", "no noise"),
    "twice the noise": ("twice the noise", "", ""),
    "noise on every pixel": ("", "", "noise on every pixel"),
    "one threshold, .2": ("threshold .2", "", "threshold .2"),
    "thresholds drawn about it": ("thresholds about the matched one", "", ""),
    "thresholds .05 to 2": ("thresholds .05 to 2", "wide thresholds", "thresholds .05 to 2"),
    "one prompt": ("", "", "1 scene"),
    "three prompts": ("", "", "3 scenes"),
    "ten prompts": ("", "", "10 scenes"),
    "thirty prompts": ("", "", "30 scenes"),
    "a third of the clips": ("a third of the clips", "", ""),
    "three times the clips": ("three times the clips", "", ""),
    "films": ("", "", "films"),
    "moved photos": ("", "", "moved photos"),
    "bare background": ("bare background", "", ""),
    "no pauses": ("no pauses", "", ""),
    "farther away": ("naive framing", "", ""),
    "things as recorded": ("things as recorded", "", ""),
    "drawn as recommended": ("recommended", "recommended", ""),
    "drawn about a DAVIS346": ("stream physical", "stream physical", ""),
    "drawn as by V2V": ("v2v", "v2v", ""),
    "latency of 40 Hz": ("", "latency of 40 Hz", ""),
    "higher contrast": ("", "high contrast", ""),
}
Draw = Callable[[tuple[str, ...]], Figure]


def make_plots(folder: Path) -> None:
    """Write NAME-light.svg and NAME-dark.svg of every plot."""
    for name, draw in PLOTS.items():
        for look, (ink, faint, colours) in LOOKS.items():
            style: dict[str, Any] = {
                "text.color": ink,
                "axes.labelcolor": ink,
                "axes.edgecolor": faint,
                "xtick.color": ink,
                "ytick.color": ink,
                "grid.color": faint,
                "legend.frameon": False,
                "font.size": 11,
                "axes.grid": True,
                "axes.grid.axis": "x",
                "axes.axisbelow": True,
                "axes.spines.top": False,
                "axes.spines.right": False,
                "axes.spines.left": False,
                "ytick.major.size": 0,
                "axes.titlesize": "medium",
                "axes.titlelocation": "left",
                "figure.constrained_layout.use": True,
                "svg.hashsalt": name,
            }
            with plt.rc_context(style):
                figure = draw(colours)
                figure.savefig(
                    folder / f"{name}-{look}.svg", transparent=True, metadata={"Date": None}
                )
                plt.close(figure)


def read(name: str) -> dict[str, Any]:
    """Results by file name, compressed or not."""
    data = (RESULTS / name).read_bytes()
    result: dict[str, Any] = json.loads(gzip.decompress(data) if name.endswith(".gz") else data)
    return result


def dots(axes: Axes, rows: list[str], series: dict[str, list[float | None]], colours: Any) -> None:
    """One row per name, one mark per series; the first row at the top."""
    marks = ("o", "s", "D", "^", "v")
    for number, (label, values) in enumerate(series.items()):
        axes.scatter(
            [float("nan") if value is None else value for value in values],
            range(len(rows)),
            s=52,
            marker=marks[number],
            color=colours[number],
            label=label,
            clip_on=False,
            zorder=3,
        )
    axes.set_yticks(range(len(rows)), rows)
    axes.set_ylim(len(rows) - 0.4, -0.6)


def legend(figure: Figure, axes: Axes, columns: int) -> None:
    """Below the plots, so that it hides nothing."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=columns)


def fidelity(colours: tuple[str, ...]) -> Figure:
    """Mean S* over scenes, by simulator and what fills the time between frames."""
    found: dict[tuple[str, str], list[float]] = {}
    for score in read("fidelity.json.gz")["scores"]:
        simulator, _, between = score["entry"].rpartition(", ")
        value = score["normalised"]["stpp"]
        if value is not None:
            found.setdefault((simulator, between), []).append(value)
    names = {"exact": "true frames", "flow": "motion", "blend": "blending", "none": "nothing"}
    series = {
        label: [mean(found[simulator, between]) for simulator in SIMULATORS]
        for between, label in names.items()
    }
    figure, axes = plt.subplots(figsize=(5.8, 4.2))
    dots(axes, list(SIMULATORS), series, colours)
    axes.set_xlim(-0.02, 1)
    axes.set_xlabel("mean S*: 0 = times shuffled, 1 = a second recording")
    legend(figure, axes, 4)
    return figure


def real(colours: tuple[str, ...]) -> Figure:
    """STPP against two recordings, with and without motion between frames."""
    figure, both = plt.subplots(1, 2, figsize=(5.8, 3.6), sharey=True, sharex=True)
    names = ("physical", "texvent accurate", "texvent paper", "esim")
    for axes, recording in zip(both, ("slider_depth", "davis346"), strict=True):
        scores = {
            score["entry"]: mean(score["values"]["stpp"])
            for score in read(f"real-{recording}.json.gz")["scores"]
        }
        series: dict[str, list[float | None]] = {
            "motion estimated": [scores.get(f"{name}, flow") for name in names],
            "nothing between": [scores.get(f"{name}, none") for name in names],
        }
        dots(axes, list(names), series, (colours[0], colours[3]))
        half = scores["half of the recording"]
        axes.axvline(half, color=colours[2], linestyle="--", label="half of the recording")
        axes.set_title(recording)
        axes.set_xlabel("STPP")
    both[0].set_xlim(0.2, 0.9)
    legend(figure, both[0], 2)
    return figure


def digits(colours: tuple[str, ...]) -> Figure:
    """Accuracy on real recordings of networks that were trained on simulated ones."""
    result = read("digits.json.gz")
    names = (*SIMULATORS, "v2e noisy")
    figure, axes = plt.subplots(figsize=(5.8, 4.2))
    series: dict[str, list[float | None]] = {}
    for way, label in (("exact", "exact motion"), ("flow", "motion estimated")):
        found = {
            score["arm"]: 100 * mean(score["accuracy"])
            for score in result["scores"]
            if (score["way"], score["representation"]) == (way, "histogram")
        }
        series[label] = [found.get(name) for name in names]
    dots(axes, list(names), series, colours)
    axes.set_xlim(70, 100)
    axes.set_xlabel("recordings read correctly, %")
    legend(figure, axes, 3)
    return figure


def teaching(colours: tuple[str, ...]) -> Figure:
    """Change of each test's score where one property of the simulated clips is another."""
    scores = teaching_scores()
    names = [one for one in TEACHING if any(one in found for found in scores.values())]
    figure, axes = plt.subplots(figsize=(5.8, 1.6 + 0.36 * len(names)))
    for number, (label, found) in enumerate(scores.items()):
        for row, name in enumerate(names):
            if name in found:
                change, error = relative(*found[name])
                place = row + 0.13 * (number - (len(scores) - 1) / 2)
                mark = "osD^v"[number]
                axes.errorbar(change, place, xerr=error, fmt=mark, ms=5, color=colours[number])
        axes.plot([], [], "osD^v"[number], color=colours[number], label=label)
    axes.axvline(0, color=colours[3], linewidth=1)
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_xlabel("change of the score, % ± standard error\n(images: of 1 - LPIPS)")
    legend(figure, axes, 3)
    return figure


def teaching_scores() -> dict[str, dict[str, tuple[list[float], list[float]]]]:
    """Test → row of `TEACHING` → its scores, one per network, and those that it differs from."""
    found: dict[str, dict[str, tuple[list[float], list[float]]]] = {}
    for test, measure in (("table", "AP50 visible"), ("turntable", "accuracy")):
        found[test] = {}
        for name in ("objects-factors", "objects-clips", "objects-recipes"):
            # The last two are of other frames, with their own base.
            rows = read(f"{name}.json.gz")[test]
            arms = {row["arm"]: row["scores"][measure] for row in rows}
            found[test] |= teaching_rows(arms, "physical", 0)
    for kind, label in (("histogram", "digits, counts"), ("surface", "digits, times")):
        rows = read("digits-ablation.json.gz")["scores"]
        arms = {row["arm"]: row["accuracy"] for row in rows if row["representation"] == kind}
        found[label] = teaching_rows(arms, "as measured", 1)
    rows = read("reconstruction-factors.json.gz")["rows"]
    arms = {row["factor"]: [1 - one for one in row["scores"]["lpips"]] for row in rows}
    found["images"] = teaching_rows(arms, "as firenet.toml", 2)
    return found


def teaching_rows(
    arms: dict[str, list[float]], base: str, place: int
) -> dict[str, tuple[list[float], list[float]]]:
    """Row of `TEACHING` → scores of the arm that one of its tests has for it, and of the base."""
    names = {row: tests[place] for row, tests in TEACHING.items()}
    return {row: (arms[name], arms[base]) for row, name in names.items() if name in arms}


def relative(values: list[float], base: list[float]) -> tuple[float, float]:
    """Change of a mean from the base's, and its standard error, % of the base's."""
    error = (variance(values) / len(values) + variance(base) / len(base)) ** 0.5
    return 100 * (mean(values) / mean(base) - 1), 100 * error / mean(base)


def speed(colours: tuple[str, ...]) -> Figure:
    """Time of the cores per pair of frames, beside other programs."""
    peers = [
        row for row in read("speed.json.gz")["peers"] if "with flow" not in row["ours"]["name"]
    ]
    rows = [
        f"{row['clip']}\n{row['size']}, {row['ours']['name'].removeprefix('texvent, ')}"
        for row in peers
    ]
    series: dict[str, list[float | None]] = {
        "texvent": [row["ours"]["ms_per_pair"]["median"] for row in peers]
    }
    for number, name in enumerate(("eventcv", "evlib")):
        series[name] = [row["peers"][number]["ms_per_pair"]["median"] for row in peers]
    figure, axes = plt.subplots(figsize=(5.8, 3.6))
    dots(axes, rows, series, colours)
    axes.set_xscale("log")
    axes.set_xlim(0.1, 30)
    axes.set_xticks([0.1, 0.3, 1, 3, 10, 30], ["0.1", "0.3", "1", "3", "10", "30"])
    axes.set_xlabel("ms per pair of frames, one core")
    legend(figure, axes, 3)
    return figure


def codecs(colours: tuple[str, ...]) -> Figure:
    """Millions of events per second read and written, for formats that two programs share."""
    rates: dict[tuple[str, str], dict[str, float]] = {}
    for row in read("codecs.json")["rows"]:
        for way in ("read", "write"):
            if row.get(way):
                found = rates.setdefault((row["format"], way), {})
                found[row["program"]] = row[way]["median"]
    programs = sorted({name for found in rates.values() for name in found})
    programs.sort(key=lambda name: name != "texvent")
    figure, both = plt.subplots(1, 2, figsize=(5.8, 4.4), sharex=True, sharey=True)
    formats = [
        name for name in dict.fromkeys(name for name, _ in rates) if len(rates[name, "read"]) > 1
    ]
    for axes, way in zip(both, ("read", "write"), strict=True):
        series = {
            program: [rates.get((name, way), {}).get(program) for name in formats]
            for program in programs
        }
        dots(axes, formats, series, colours)
        axes.set_title(way)
        axes.set_xscale("log")
        axes.set_xlabel("million events / s")
    legend(figure, both[0], 3)
    return figure


PLOTS: dict[str, Draw] = {
    "fidelity": fidelity,
    "real": real,
    "digits": digits,
    "teaching": teaching,
    "speed": speed,
    "codecs": codecs,
    "grating": grating,
}
