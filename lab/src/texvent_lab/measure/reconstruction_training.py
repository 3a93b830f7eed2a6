"""FireNet trained on the same scenes with the events of several simulators, scored on recordings.

    OMP_NUM_THREADS=1 python -m texvent_lab.measure.reconstruction_training -o FOLDER [--json FILE]
        [--arms accurate,esim,v2e] [--seeds 2] [--recordings slider_depth,davis346]
        [--published firenet=FILE --published firenet+=FILE]
    python -m texvent_lab.measure.reconstruction_training --show FILE [--figure FILE]

Every arm is a variant of the specification that configs/training/firenet.toml names; all arms of a
seed begin with the same weights, and see the same scenes with the same thresholds in the same
order. A run that was stopped goes on. The recorded events alone are scored, as by `texvent bench
reconstruction`, beside published networks and an image that is grey all over.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from texvent.extending import full_version, require
from texvent.metrics.image_measures import Measures, load_measures
from texvent.options.values import plain
from texvent.runtime.progress import NO_PROGRESS
from texvent_lab.bench.document import describe_environment, read_document, write_document
from texvent_lab.bench.real.recording import FrameRecording, locate_source, open_recording
from texvent_lab.bench.reconstruction.run import ReconstructionPlan, ReconstructionScorer
from texvent_lab.bench.reconstruction.scores import ImageScores, ScoreCollector, true_image
from texvent_lab.reconstruct.reconstructor import load_reconstructor
from texvent_lab.train.loop import LOSS, train
from texvent_lab.train.reconstruction.config import ReconstructionConfig
from texvent_lab.train.run import read_training
from texvent_lab.train.schedule import EXTRA, Hardware

SCHEMA = "texvent-reconstruction-training-1"
GREY = 0.5
CURVES = (LOSS, "ssim", "lpips", "mse")
PLAN = ReconstructionPlan(entries=())


def main() -> None:
    """Train, score, print the table, and write the document with --json."""
    arguments = _arguments()
    if arguments.show is not None:
        shown = read_document(arguments.show)
        print(table(shown["rows"]))
        if arguments.figure is not None:
            draw_curves(shown["runs"]).savefig(arguments.figure, dpi=90)
        return
    config = read_training(arguments.training, ReconstructionConfig())
    recordings = {
        name: open_recording(locate_source(name)[0]) for name in arguments.recordings.split(",")
    }
    measures = load_measures()
    rows = [score_grey(name, one, measures) for name, one in recordings.items()]
    for one in arguments.published:
        network, _, path = one.partition("=")
        rows += score_weights(network, Path(path), recordings, measures, {"source": "published"})
    runs = []
    # Arm by arm within a seed: what is stopped early has as many seeds of each.
    for seed in range(arguments.seeds):
        for arm in arguments.arms.split(","):
            folder = arguments.out / f"{arm}-{seed}"
            run = replace(config, seed=seed, data=replace(config.data, variant=arm))
            history = train_arm(run, folder)
            facts = {"source": "trained", "arm": arm, "seed": seed}
            runs.append({**facts, "epochs": history})
            weights = folder / "weights.pt"
            rows += score_weights(config.network.name, weights, recordings, measures, facts)
            if arguments.json is not None:
                write_document(arguments.json, document(config, rows, runs), overwrite=True)
    print(table(rows))


def train_arm(config: ReconstructionConfig, folder: Path) -> list[dict[str, float]]:
    """Train on the CPU, or go on; the scores of all epochs."""
    state = train(
        config.make_task(),
        config.schedule,
        folder,
        tables=plain(config),
        hardware=Hardware(device="cpu"),
        progress=NO_PROGRESS,
    )
    return state.rows


def score_weights(
    network: str,
    weights: Path,
    recordings: Mapping[str, FrameRecording],
    measures: Measures,
    facts: dict[str, Any],
) -> list[dict[str, Any]]:
    """Means over the images of each recording."""
    reconstructor = load_reconstructor(network, weights, device="cpu")
    scorer = ReconstructionScorer(reconstructor=reconstructor, measures=measures, plan=PLAN)
    rows = []
    for name, recording in recordings.items():
        scores = scorer.score(recording, recording.events).scores
        rows.append(
            {
                **facts,
                "network": network,
                "recording": name,
                **means_of(scores),
            }
        )
    return rows


def score_grey(name: str, recording: FrameRecording, measures: Measures) -> dict[str, Any]:
    """The same for an image that shows nothing."""
    span_us, skip = PLAN.scored_part(recording)
    collector = ScoreCollector(measures, span_us=span_us, skip=skip)
    frames = iter(recording.frames)
    next(frames)  # no image belongs to the first frame
    for frame in frames:
        true = true_image(frame)
        collector.add(frame.t_us, np.full_like(true, GREY), true)
    scores = collector.scores()
    return {
        "source": "grey",
        "network": "",
        "recording": name,
        **means_of(scores),
    }


def means_of(scores: ImageScores) -> dict[str, Any]:
    """Number of images, and means over them."""
    mean = {measure: scores.mean(measure) for measure in scores.values}
    return {"images": len(scores.t_us), "mean": mean}


def document(
    config: ReconstructionConfig, rows: list[dict[str, Any]], runs: list[dict[str, Any]]
) -> dict[str, Any]:
    """Everything found so far, ready for JSON."""
    return {
        "schema": SCHEMA,
        "environment": {**describe_environment(), "full_version": full_version()},
        "training": plain(config),
        "rows": rows,
        "runs": runs,
    }


def table(rows: list[dict[str, Any]]) -> str:
    """Mean of each arm over seeds, and the smallest and largest seed."""
    return "\n".join(_lines(rows))


def _lines(rows: list[dict[str, Any]]) -> Iterator[str]:
    names = list(rows[0]["mean"])
    yield "| recording | events of training | " + " | ".join(names) + " |"
    yield "|---" * (2 + len(names)) + "|"
    keys = dict.fromkeys((row["recording"], label(row)) for row in rows)
    for recording, name in keys:
        chosen = [row for row in rows if (row["recording"], label(row)) == (recording, name)]
        cells = []
        for measure in names:
            values = [row["mean"][measure] for row in chosen]
            spread = f" ({min(values):.3f}–{max(values):.3f})" if len(values) > 1 else ""
            cells.append(f"{np.mean(values):.3f}{spread}")
        yield f"| {recording} | {name} | " + " | ".join(cells) + " |"


def draw_curves(runs: list[dict[str, Any]]) -> Any:
    """A matplotlib figure: scores on the arm's own validation clips by epoch, a line per run."""
    names = [name for name in CURVES if name in runs[0]["epochs"][0]]
    figure = require("matplotlib.figure", extra=EXTRA).Figure(
        figsize=(4 * len(names), 3), layout="constrained"
    )
    arms = list(dict.fromkeys(run["arm"] for run in runs))
    for axes, name in zip(figure.subplots(1, len(names), squeeze=False)[0], names, strict=True):
        for run in runs:
            epochs = run["epochs"]
            axes.plot(
                [row["epoch"] for row in epochs],
                [row[name] for row in epochs],
                color=f"C{arms.index(run['arm'])}",
                label=run["arm"] if run["seed"] == 0 else None,
            )
        axes.set(title=name, xlabel="epoch")
        axes.grid(alpha=0.3)
    axes.legend()
    return figure


def label(row: dict[str, Any]) -> str:
    """What a row is called in the table."""
    if row["source"] == "trained":
        return str(row["arm"])
    return f"{row['source']} {row['network']}".strip()


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description="Train FireNet on simulators, score on recordings."
    )
    parser.add_argument(
        "-o", "--out", type=Path, default=Path("reconstruction-training"), help="of the trainings"
    )
    parser.add_argument(
        "--training", type=Path, default=Path("configs/training/firenet.toml"), help="TOML"
    )
    parser.add_argument("--arms", default="accurate,esim,v2e")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--recordings", default="slider_depth,davis346")
    parser.add_argument(
        "--published", action="append", default=[], help="NETWORK=FILE, scored beside"
    )
    parser.add_argument("--json", type=Path, help="keep the result")
    parser.add_argument("--show", type=Path, help="a result that was kept; nothing is trained")
    parser.add_argument("--figure", type=Path, help="learning curves of that result, PNG")
    return parser.parse_args()


if __name__ == "__main__":
    main()
