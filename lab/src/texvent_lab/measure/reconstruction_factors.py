"""Properties of simulated events that teach reconstruction: one at a time is replaced.

A network is trained as a file says, once per factor and seed, and scored by the images that it
makes of the events of a recording, in EVREAL's part where it names one. The network is that of the
last epoch, since two clips that validate cannot choose one. Trainings are kept.

    texvent data pull slider_depth
    texvent weights pull lpips
    cd configs/training
    python -m texvent_lab.measure.reconstruction_factors reconstruction-factors.toml slider_depth
        --work work -o factors.json

The file names the training and, per factor, `options` of the simulator, those of the `video`, a
number of `scenes`, each made so often that clips are as many, another `specification` and its
`variant`, or the draws of a training `stream` that takes the simulator's place.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.config import check_range
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.items import Item
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.specification.specification import SampleSource, Specification, Variant
from texvent.errors import ConfigError, TexventError, shown
from texvent.extending import suggest
from texvent.options.values import plain
from texvent.runtime.files.cache_folder import make_folder
from texvent.runtime.progress import NO_PROGRESS
from texvent.settings.config_files import read_document
from texvent.training.draws import RANGES
from texvent_lab.bench.document import describe_environment, read_records, write_document
from texvent_lab.bench.reconstruction.factors import SCHEMA, FactorScore, factors_table
from texvent_lab.bench.reconstruction.run import ReconstructionPlan, ReconstructionScorer
from texvent_lab.frame_recordings import FrameRecording, locate_source, open_recording
from texvent_lab.reconstruct.image_measures import load_measures
from texvent_lab.train.reconstruction.config import ReconstructionConfig
from texvent_lab.train.run import read_training
from texvent_lab.train.schedule import Hardware

KEYS = ("options", "video", "scenes", "specification", "variant", "stream")


@dataclass(frozen=True)
class Scale:
    """Size of every training; None: as its file says."""

    clips: int | None = None
    """Clips to learn from, evenly chosen; of films and photos as many as are next to it."""
    epochs: int | None = None

    def __post_init__(self) -> None:
        check_range("clips", self.clips, 1)
        check_range("epochs", self.epochs, 1)


def changed(
    spec: Specification,
    variant: str,
    changes: Mapping[str, Any],
    listed: Path,
    clips: int | None = None,
) -> Specification:
    """A specification of one variant with some of its options replaced, or of fewer scenes.

    Args:
        spec: sources of the clips.
        variant: of it.
        changes: `options` of the simulator, those of the `video`, and the number of `scenes` of its
            training clips, each with other seeds so often that clips are as many; those of other
            splits stay.
        listed: file to write, that lists the clips where some are left out.
        clips: to learn from; None: all.

    Raises:
        ConfigError: there is no such variant, or there are fewer scenes.
    """
    known = {one.name: one for one in spec.variants}
    if variant not in known:
        raise ConfigError(f"unknown variant {shown(variant)}; {suggest(variant, tuple(known))}")
    options = {**known[variant].options, **changes.get("options", {})}
    spec = dataclasses.replace(
        spec,
        options={**spec.options, **changes.get("video", {})},
        variants=(Variant(name=variant, options=options),),
    )
    count = changes.get("scenes")
    if count is None and clips is None:
        return spec
    every = Recipe.of(spec).clips
    items = {
        split: [every.clip(split, number).item for number in range(every.counts[split])]
        for split in every.counts
    }
    if any(one.prompt is None for one in items["train"]):
        shown_once = len(items["train"]) / spec.repeats
        return dataclasses.replace(spec, repeats=max(1, round((clips or 0) / shown_once)))
    learned = _spread(items["train"], clips or len(items["train"]))
    count = len(learned) if count is None else count
    if count not in range(1, len(learned) + 1):
        raise ConfigError(f"scenes is {shown(count)}; there are {len(learned)} prompts to learn")
    chosen = _spread(learned, count)
    rows = [
        {"prompt": chosen[number % count].prompt, "seed": number // count}
        for number in range(len(learned))
    ]
    listed.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    others = [
        SampleSource(prompts=tuple(str(one.prompt) for one in some), split=split)
        for split, some in items.items()
        if split != "train"
    ]
    return dataclasses.replace(spec, sources=(SampleSource(file=listed, split="train"), *others))


def _spread(items: Sequence[Item], count: int) -> list[Item]:
    """So many of the items, evenly chosen; all, where they are fewer."""
    count = min(count, len(items))
    return [items[number * len(items) // count] for number in range(count)]


def trainings(
    path: Path, work: Path, names: Sequence[str] | None, scale: Scale = Scale()
) -> dict[str, ReconstructionConfig]:
    """Factor → its training; the specification of each is written to the work folder.

    Raises:
        InputError, ConfigError: a file cannot be read or does not fit.
    """
    document = read_document(path)
    base = read_training(path.parent / str(document.get("training")), ReconstructionConfig())
    factors = dict(document.get("factors", {}))
    found = {}
    for number, (name, changes) in enumerate(factors.items()):
        for key in changes:
            if key not in KEYS:
                raise ConfigError(f"{path}: {name}: unknown {shown(key)}; {suggest(key, KEYS)}")
        draws = changes.get("stream")
        if draws is not None and draws not in RANGES:
            allowed = suggest(str(draws), tuple(RANGES))
            raise ConfigError(f"{path}: {name}: stream is {shown(draws)}; {allowed}")
        if names and name not in names:
            continue
        own = changes.get("specification")
        source = (path.parent / own if own else base.data.specification).resolve()
        variant = str(changes.get("variant", base.data.variant))
        make_folder(work)
        written = work.resolve() / f"factor-{number}.yaml"
        listed = written.with_suffix(".jsonl")
        spec = changed(read_specification(source), variant, changes, listed, scale.clips)
        written.write_text(json.dumps(spec.tables), encoding="utf-8")  # JSON is YAML
        data = dataclasses.replace(base.data, specification=written, variant=variant)
        has_flow = not own and draws is None
        loss = base.loss if has_flow else dataclasses.replace(base.loss, consistency=0.0)
        epochs = scale.epochs or base.schedule.epochs
        schedule = dataclasses.replace(base.schedule, epochs=epochs, keep="last")
        found[name] = dataclasses.replace(base, data=data, loss=loss, schedule=schedule)
    if missing := set(names or ()) - set(found):
        wrong = min(missing)
        raise ConfigError(f"unknown factor {shown(wrong)}; {suggest(wrong, tuple(factors))}")
    return found


def score(name: str, weights: Path | None, recording: FrameRecording) -> dict[str, Any]:
    """Means of the measures over the images that a network makes of recorded events.

    Raises:
        InputError: there are no weights.
    """
    from texvent_lab.reconstruct.reconstructor import load_reconstructor  # imports torch

    network = load_reconstructor(name, weights)
    scorer = ReconstructionScorer(
        reconstructor=network, measures=load_measures(), plan=ReconstructionPlan()
    )
    scores = scorer.score(recording, recording.events).scores
    return {name: scores.mean(name) for name in scores.values}


def score_published(names: Sequence[str], recording: FrameRecording) -> list[dict[str, Any]]:
    """Rows of published networks, whose weights are found as `texvent reconstruct` finds them.

    Raises:
        ConfigError: unknown name, or one that gives depth.
        InputError: there are no weights.
    """
    from texvent_lab.reconstruct.reconstructor import find_network  # imports torch

    rows = []
    for name in names:
        find_network(name)
        found = score(name, None, recording)
        scores = {measure: [value] for measure, value in found.items()}
        rows.append({"factor": f"{name}, as published", "scores": scores})
    return rows


def run(
    path: Path,
    source: str,
    work: Path,
    seeds: int,
    names: Sequence[str] | None,
    scale: Scale = Scale(),
    published: Sequence[str] = (),
) -> Any:
    """Train and score what was not before, after networks as they were published; the document."""
    from texvent_lab.train.loop import train  # imports torch
    from texvent_lab.train.reconstruction.streamed import StreamedTask

    start, rows = time.perf_counter(), []
    recording = dataclasses.replace(open_recording(locate_source(source)[0]), name=source)
    yardsticks = score_published(published, recording)
    configs = trainings(path, work, names, scale)
    draws = {name: one.get("stream") for name, one in read_document(path)["factors"].items()}
    for name, config in configs.items():
        values: dict[str, list[float]] = {}
        for seed in range(seeds):
            one = dataclasses.replace(config, seed=seed)
            folder = work / f"{config.data.specification.stem}-{seed}"
            options: Any = {"hardware": Hardware(device="cpu"), "progress": NO_PROGRESS}
            task, tables = one.make_task(), plain(one)
            if draws[name] is not None:
                task, tables = StreamedTask(one, draws[name]), {**tables, "stream": draws[name]}
            train(task, one.schedule, folder, tables=tables, **options)
            for measure, value in score(one.network.name, folder / "weights.pt", recording).items():
                values.setdefault(measure, []).append(value)
            print(f"{name}, seed {seed}: {time.perf_counter() - start:.0f} s", file=sys.stderr)
        rows.append({"factor": name, "scores": values})
    return {
        "schema": SCHEMA,
        "environment": describe_environment(),
        "recording": source,
        "protocol": {"networks per row": seeds, **dataclasses.asdict(scale)},
        "rows": [*rows, *yardsticks],
        "seconds": time.perf_counter() - start,
    }


def main() -> int:
    """Run it; 2 where an input will not do."""
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.reconstruction_factors")
    parser.add_argument("factors", type=Path, help="file of the training and its factors")
    parser.add_argument("recording", help="of frames and events: a path, or a pulled data set")
    parser.add_argument("--work", type=Path, required=True, help="folder that keeps trainings")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--clips", type=int, help="clips to learn from; default: all")
    parser.add_argument("--epochs", type=int, help="of each training; default: as its file says")
    parser.add_argument("--names", help="factors, separated by commas; default: all")
    parser.add_argument("--published", help="networks to score beside them, such as pie-net")
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--overwrite", action="store_true")
    given = parser.parse_args()
    names, published = (one.split(",") if one else None for one in (given.names, given.published))
    try:
        scale = Scale(given.clips, given.epochs)
        document = run(
            given.factors, given.recording, given.work, given.seeds, names, scale, published or ()
        )
        if given.out:
            write_document(given.out, document, overwrite=given.overwrite)
    except TexventError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    sys.stdout.write(factors_table(read_records(FactorScore, document["rows"])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
