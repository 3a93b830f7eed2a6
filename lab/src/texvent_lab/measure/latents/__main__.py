"""Events from a video's latents: by a full decoder, a tiny one, and a head without frames.

    python -m texvent_lab.measure.latents run -o FOLDER [--json FILE]
    python -m texvent_lab.measure.latents cost [--json FILE]
    python -m texvent_lab.measure.latents show FILE

run trains an autoencoder, a tiny decoder and a head on the training scenes of
configs/training/latent-scenes.toml, and scores events of the test scenes; what is in FOLDER is not
trained again. cost counts operations at 720p. FILE keeps what the other commands wrote. It needs
torch: pip install 'texvent[generate,train]'.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from texvent.extending import full_version
from texvent.options.values import plain
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.runtime.progress import Progress
from texvent_lab.bench.machine import describe_environment
from texvent_lab.latents.autoencoder import Autoencoder
from texvent_lab.latents.head import load_head
from texvent_lab.measure.latents import autoencoders, cost, score
from texvent_lab.train.checkpoint import WEIGHTS_FILE
from texvent_lab.train.latents.config import LatentsConfig
from texvent_lab.train.latents.pairs import LatentPairs
from texvent_lab.train.loop import train
from texvent_lab.train.reading import read_training
from texvent_lab.train.schedule import Hardware

TRAINING = Path("configs/training/latent-head.toml")
SCHEMA = "texvent-latents-1"
CPU = Hardware(device="cpu")


def main() -> None:
    """Print the tables, and keep the document."""
    options = _arguments()
    autoencoders.torch.set_num_threads(options.threads)
    if options.command == "show":
        found = json.loads(options.file.read_text("utf-8"))
    else:
        with ConsoleProgress() as progress:
            made = cost.count_all() if options.command == "cost" else run(options, progress)
        found = {options.command: made}
        if options.json:
            known = json.loads(options.json.read_text("utf-8")) if options.json.exists() else {}
            environment = {**describe_environment(), "full_version": full_version()}
            document = {**known, "schema": SCHEMA, "environment": environment, **found}
            options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    if "run" in found:
        print(score.table(found["run"]["summary"]))
    if "cost" in found:
        print(cost.table(found["cost"]))


def run(options: argparse.Namespace, progress: Progress) -> dict[str, Any]:
    """Train what is missing in the folder, and score."""
    config = read_training(TRAINING, LatentsConfig())
    folder: Path = options.out
    config = replace(
        config, data=replace(config.data, autoencoder=folder / "vae", cache=folder / "scenes")
    )
    specification = config.data.specification
    tiny = folder / "tiny"
    if not (folder / "vae").exists() or not tiny.exists():
        frames = autoencoders.read_frames(specification, "train")
        if not (folder / "vae").exists():
            made = autoencoders.train_autoencoder(frames, options.steps, progress)
            made.save_pretrained(folder / "vae")
        full = Autoencoder.load(folder / "vae").module
        made = autoencoders.train_tiny_decoder(full, frames, options.steps // 2, progress)
        made.save_pretrained(tiny)
    task, tables = config.make_task(), plain(config)
    state = train(
        task, config.schedule, folder / "head",
        tables=tables, hardware=CPU, progress=progress,
    )  # fmt: skip
    pairs = LatentPairs(config.data, "test", config.network.bins, config.network.balance)
    ways = score.Ways(
        pairs.autoencoder, Autoencoder.load(tiny), load_head(folder / "head" / WEIGHTS_FILE)
    )
    rows = score.score(ways.run, pairs.scenes, options.scenes or len(pairs), progress)
    return {
        "steps": options.steps,
        "head": {**asdict(ways.head.config), "best": state.rows[state.best_epoch - 1]},
        "summary": score.summarise(rows),
        "rows": rows,
    }


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    running, counting = map(commands.add_parser, ("run", "cost"))
    commands.add_parser("show").add_argument("file", type=Path)
    running.add_argument("-o", "--out", type=Path, required=True, help="kept between runs")
    running.add_argument("--scenes", type=int, help="scored; default: all of the test split")
    running.add_argument("--steps", type=int, default=12_000, help="of the autoencoder's training")
    for command in (running, counting):
        command.add_argument("--json", type=Path, help="keep the result")
    parser.add_argument("--threads", type=int, default=1, help="of torch")
    return parser.parse_args()


if __name__ == "__main__":
    main()
