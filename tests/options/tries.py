"""Commands whose options are tried, and values to try."""

import re
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from texvent._registry import SIMULATORS
from texvent.settings.presets import presets_by_simulator


class Try(NamedTuple):
    """Another value of an option, or two of which the second gives more."""

    words: str
    changes: str = ""
    """Part of `Outcome`, without it that of the command; or a figure, of two values."""
    beside: str = ""
    """Words of all runs."""
    base: str = ""
    """Command line of all runs, in place of that of the table."""
    before: str = ""
    """Command line of a run before them, in the same folder; "BASE": that without the option."""


class Command(NamedTuple):
    """A run to which options are added."""

    words: str
    changes: str = "events"
    """Part of `Outcome` that its options change."""
    shared: tuple[str, ...] = ()
    """Options, or sections of its help, that another command tries."""


READING = ("sensor", "time-unit", "columns", "stream", "repair", "format")
LENS = ("point-spread", "vignetting")
SIMULATION = ("run", "interpolate", "simulate")
CLIP = "simulate ../clip.npy --fps 5 --previews none -o o.npz"
FRAMES = "simulate ../frames --previews none -o o.npz"
FILM = "simulate ../film.npy --fps 25 --previews none --noise none -o o.npz"
MOTION = "--motion ../forward.npy --interpolate motion"
STILL = "simulate ../still.png --sensor 16x12 --previews none -o o.npz"
SMALL = "--sensor 24x18 --duration 0.125 --samples 1 --previews none"
SCENE = f"generate 'a red ball bounces in a room' {SMALL}"
BATCH = f"batch ../prompts.txt {SMALL} --format npz"
RIG = "rig 'a red ball bounces in a room' --sensor 16x12 --duration 0.125 --samples 1"
REST = "calibrate --events ../rest.npz -o o.toml"
FLICKER = "calibrate --events ../flicker.npz --flicker-hz 5 -o o.toml"
MOVING = (
    "calibrate --frames ../moving.npy --fps 50 --events ../moving.npz --seconds 0.1 "
    "--interpolate none -o o.toml"
)
CONVERT = "convert ../events.h5 o.npz"
EVENTS = "../events.h5"
WORDS = {
    name: value for name, value in globals().items() if name.isupper() and isinstance(value, str)
}
"""Word in capitals of `tries.txt` → what it stands for."""
COMMANDS_TRIED: dict[str, Command] = {
    "simulate": Command(CLIP, shared=("simulate",)),
    **{
        f"simulate --simulator {one}": Command(
            f"{CLIP} --simulator {one}",
            shared=("input", "output", "run", "capture", "interpolate"),
        )
        for one in SIMULATORS.builtin
    },
    "generate": Command(f"{SCENE} -o o.npz", shared=("keep-partial", "palette", *SIMULATION)),
    "batch": Command(BATCH, shared=("palette", "shadows", "hdr", "samples", *LENS, *SIMULATION)),
    "rig": Command(RIG, "files", shared=("shadows", "hdr", "samples", *LENS, *SIMULATION)),
    "check": Command("check ../clip.npy --fps 5 --json", "printed", shared=("quiet",)),
    "calibrate": Command(REST, "said", shared=("capture", "interpolate")),
    "convert": Command(CONVERT),
    "render": Command(f"render {EVENTS} -o o.png", "files", shared=READING),
    "view": Command(f"view {EVENTS} -o o.html", "files", shared=READING),
    "info": Command(f"info {EVENTS}", "printed", shared=READING),
    "validate": Command(f"validate {EVENTS}", "printed", shared=READING),
    "compare": Command(
        f"compare {EVENTS} ../others.h5 --metrics count_ratio", "printed", shared=READING
    ),
    "scenes": Command("scenes", "printed"),
    "generators": Command("generators", "printed"),
    "doctor": Command("doctor", "printed"),
    "dataset plan": Command("dataset plan ../cars.toml --trial 0", "printed", shared=("workers",)),
    "dataset make": Command("dataset make ../cars.toml -o cars --workers 1", "names"),
    "dataset verify": Command("dataset verify ../cars", "printed"),
    "dataset stats": Command("dataset stats ../cars", "printed"),
    "dataset sample": Command("dataset sample ../cars -o o.html", "files"),
    "dataset export": Command("dataset export ../cars -o o --variant paper", "names"),
}
"""Command, or one with the word that decides which options it has → how it is run."""


def read_lines(name: str) -> list[str]:
    """Lines of a file beside this one, without its remarks."""
    lines = Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def read_tries() -> dict[str, list[Try]]:
    """Option, perhaps behind its command → what to try; those of `tries.txt` and of tables."""
    found: dict[str, list[Try]] = defaultdict(list)
    for line in read_lines("tries.txt"):
        filled = re.sub(r"\b[A-Z]{3,}\b", lambda word: WORDS.get(word[0], word[0]), line)
        key, values, *cells = (cell.strip() for cell in filled.split("|"))
        found[key] += [Try(one.strip(), *cells) for one in values.split(";")]
    default, *others = SIMULATORS.builtin
    found["--simulator"] = [Try(f"--simulator {one}") for one in others]
    found["--preset"] = [Try(f"--preset {one}") for one in presets_by_simulator()[default][1:]]
    return found


ELSEWHERE: dict[tuple[str, str], str] = {
    ("simulate", "keep-partial"): "tests/cli/test_nothing_lost.py",
    ("simulate", "interpolator-weights"): "tests/interpolate/rife",
    ("simulate", "rife-flow"): "tests/interpolate/rife",
    ("simulate", "device"): "tests/simulation/gpu",
    ("dataset make", "device"): "tests/dataset/generation/test_batches.py",
    ("convert", "frames"): "tests/capture/test_aedat4_frames.py",
    ("convert", "triggers"): "tests/io/test_side_data.py",
    ("convert", "imu"): "tests/io/test_side_data.py",
    ("generate", "llm-url"): "tests/scenes/llm/test_llm.py",
    ("generate", "llm-model"): "tests/scenes/llm/test_llm.py",
}
"""(command, option) → the tests that show its effect, which needs more than a small run."""
SERVED = {
    "app": "tests/web/test_page.py",
    "live": "tests/web/test_live.py",
    "data": "tests/data/test_pull.py",
    "weights": "tests/weights",
}
"""Commands that serve a page or ask an index → the tests that show the effects of their options."""
