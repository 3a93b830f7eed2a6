"""Runs whose events are pinned: `golden_events.json` and `golden_files.json` hold their digests.

    python -m tests.contract.golden   # writes both anew; CHANGELOG.md must say why

Cases use the public API alone, so they outlive any change of the code behind it.
"""

import hashlib
import json
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import texvent

FOLDER = Path(__file__).parent
EVENTS_FILE = FOLDER / "golden_events.json"
FILES_FILE = FOLDER / "golden_files.json"
PROMPT = "a red car drives left past two trees"
GENERATE = {"sensor": "48x36", "duration": 0.25, "seed": 5}

PAPER = {"preset": "paper"}
SIMULATORS: dict[str, list[dict[str, Any]]] = {
    "texvent": [
        {},
        {"residual_decay_hz": 3.0},
        {"cache": "none"},
        {"reset": "current"},
        {"noise": "random"},
        {"noise": "gaussian"},
        {"label_noise": True},
        {"keep_events": "noise", "noise_intensity": 255.0},
        {"randomize": "stoffregen"},
        {"target_rate": 20_000.0},
        PAPER,
        {**PAPER, "cache": "global"},
        {**PAPER, "cache": "none"},
        {**PAPER, "reset": "step"},
        {**PAPER, "timestamp_rule": "linear"},
        {**PAPER, "noise": "random"},
        {**PAPER, "noise": "none"},
        {**PAPER, "noise": "gaussian"},
    ],
    "esim": [{}, {"refractory_period_us": 3000}, {"threshold_sigma": 0.05}],
    "physical": [{}, {"preset": "clean"}, {"sensor": "davis346"}],
    "v2e": [{}, {"preset": "noisy"}],
    "voltmeter": [{}],
    "senpi": [{}],
}
FLOW = {"interpolate": "flow"}
STILL = {"dtype": "still", "interpolate": "flow"}
MORE_CASES: list[dict[str, Any]] = [
    {**STILL, "simulator": "texvent"},
    {**STILL, "simulator": "texvent", **PAPER},
    {**STILL, "simulator": "texvent", **PAPER, "cache": "none"},
    {**STILL, "simulator": "texvent", **PAPER, "cache": "global"},
    {**STILL, "simulator": "esim"},
    {**FLOW, "simulator": "texvent", **PAPER, "dtype": "float32"},
    {**FLOW, "simulator": "texvent", "fixed_count": 3},
    {**FLOW, "simulator": "texvent", "frames_per_pixel": 1.0},
    {**FLOW, "simulator": "texvent", "detect_cuts": False},
    {**FLOW, "simulator": "texvent", "deflicker": True},
]
INTERPOLATIONS = ("none", "blend", "flow")
OPTION_CASES: list[dict[str, Any]] = [
    {"simulator": "texvent", "timestamp_rule": "random"},
    {"simulator": "texvent", "timestamp_rule": "end"},
    {"simulator": "voltmeter", "keep_events": "signal"},
    {"simulator": "physical", "randomize": "v2v"},
    {"simulator": "physical", "cutoff_limit_hz": 20.0},
    {"simulator": "physical", "hot_pixel_fraction": 0.02},
    {"simulator": "physical", "initial_phase": "random", "sensor_seed": 9},
    {"simulator": "physical", "scan_period_ns": 3_000_000},
    {"simulator": "voltmeter", "initial_phase": "zero"},
    {"simulator": "esim", "dtype": "flickering"},
    {"simulator": "esim", "dtype": "flickering", "deflicker": True},
    {"simulator": "esim", "dtype": "flickering", "detect_cuts": False},
    {"simulator": "esim", "dtype": "moving", "frames_per_pixel": 4.0},
    {"simulator": "texvent", "dtype": "moving", "interpolate": "motion"},
]
"""Choices and switches that no other case has; `tests.contract.test_golden` names those missing."""


MOTION = np.broadcast_to(np.float32([2, -1]), (8, 36, 48, 2))
"""Vectors of the clip "moving", px per frame."""


def clip(dtype: str = "uint8") -> np.ndarray[Any, Any]:
    """A texture that moves and brightens, [8, 36, 48], and a disc that crosses it.

    In the clip "still" only the disc moves, so that most pixels see no change; in "moving"
    everything moves as `MOTION` says; "flickering" has 16 bits, gains that jump, and a cut.
    """
    y, x = np.mgrid[:36, :48]
    frames = []
    if dtype == "moving":
        waves = [110 + 70 * np.sin((x - 2 * i) / 4.1) * np.cos((y + i) / 5.3) for i in range(8)]
        return np.round(np.array(waves)).astype(np.uint8)
    if dtype == "flickering":
        waves = 130 + 70 * np.sin(x / 4.1) * np.cos(y / 2.3)
        blocks = np.kron(np.random.default_rng(1).uniform(30, 220, (9, 12)), np.ones((4, 4)))
        flicker = [k * shot for shot in (waves, blocks) for k in (1.0, 1.1, 1.0, 0.93, 1.06)]
        return np.round(257 * np.clip(flicker, 0, 255)).astype(np.uint16)
    for number in range(8):
        i = 0 if dtype == "still" else number
        image = 110 + 70 * np.sin((x + 1.7 * i) / 4.1) * np.cos((y - 0.6 * i) / 5.3) + 3 * i
        image[np.hypot(x - 6 - 4 * number, y - 18) < 7] = 230
        image[:6, :6] = 0
        frames.append(np.clip(image, 0, 255))
    array = np.array(frames)
    if dtype == "uint16":
        return np.round(array * 257).astype(np.uint16)
    return array.astype(np.float32) if dtype == "float32" else np.round(array).astype(np.uint8)


def event_cases() -> Iterator[tuple[str, Any]]:
    """Name of a case, and a function that makes its events."""
    for simulator, variants in SIMULATORS.items():
        for options in variants:
            for interpolate in INTERPOLATIONS:
                yield _frames_case(simulator=simulator, interpolate=interpolate, **options)
        for dtype in ("uint16", "float32"):
            for interpolate in ("none", "flow"):
                yield _frames_case(simulator=simulator, interpolate=interpolate, dtype=dtype)
        yield _generate_case(simulator=simulator, interpolate="exact")
        yield _generate_case(simulator=simulator, interpolate="flow")
    for options in MORE_CASES + OPTION_CASES:
        yield _frames_case(**options)


def _name(options: dict[str, Any]) -> str:
    return " ".join(f"{name}={value}" for name, value in options.items())


def _frames_case(dtype: str = "uint8", **options: Any) -> tuple[str, Any]:
    name = _name({"frames": dtype, **options})
    more = {"motion": MOTION, "motion_back": -MOTION} if dtype == "moving" else {}
    return name, lambda: texvent.simulate(clip(dtype), fps=24, seed=5, **options, **more)


def _generate_case(**options: Any) -> tuple[str, Any]:
    name = _name({"prompt": "car", **options})
    return name, lambda: texvent.generate(PROMPT, **GENERATE, **options)


def digest(name: str, events: texvent.EventStream) -> str:
    """Number of events, and a hash of x, y, t, p and, if there is one, of the label.

    Of a rendered scene, a hash of the numbers of events per pixel: its frames differ in the last
    bit between processors, and times then by a microsecond.
    """
    columns = [events.x, events.y, events.t, events.p]
    columns += [] if events.label is None else [events.label]
    if name.startswith("prompt="):
        place = (events.p * events.size.height + events.y) * events.size.width + events.x
        columns = [np.bincount(place)]
    hashed = hashlib.sha256(str(events.size).encode())
    for column in columns:
        hashed.update(np.ascontiguousarray(column).tobytes())
    return f"{len(events)} {hashed.hexdigest()[:24]}"


def sample_events() -> texvent.EventStream:
    """Events for the files: without provenance, whose version and paths would change the bytes."""
    random = np.random.default_rng(3)
    number = 5000
    t = np.sort(random.integers(0, 400_000, number))
    x, y = random.integers(0, 128, number), random.integers(0, 128, number)
    order = np.lexsort((x, y, t))
    return texvent.EventStream(
        x=x[order], y=y[order], t=t[order], p=random.integers(0, 2, number), size=(128, 128)
    )


def file_digest(path: Path) -> str:
    """A hash of a file, or of the files of a folder.

    Of an archive, of what is in it: the headers around that differ between versions of Python.
    """
    files = sorted(path.rglob("*")) if path.is_dir() else [path]
    hashed = hashlib.sha256()
    for file in files:
        if file.is_file():
            hashed.update(file.relative_to(path.parent).as_posix().encode())
            for part in _contents(file):
                hashed.update(part)
    return hashed.hexdigest()[:24]


def _contents(file: Path) -> Iterator[bytes]:
    if not zipfile.is_zipfile(file):
        yield file.read_bytes()
        return
    with zipfile.ZipFile(file) as archive:
        for member in archive.infolist():
            yield f"{member.filename} {member.date_time} {member.compress_type}".encode()
            yield archive.read(member)


def main() -> None:
    """Write both tables anew."""
    events = {}
    for name, make in event_cases():
        if name in events:
            raise SystemExit(f"two cases are called {name!r}")
        events[name] = digest(name, make())
    EVENTS_FILE.write_text(json.dumps(events, indent=1) + "\n")
    with tempfile.TemporaryDirectory() as folder:
        FILES_FILE.write_text(json.dumps(dict(file_cases(Path(folder))), indent=1) + "\n")


def file_cases(folder: Path) -> Iterator[tuple[str, str]]:
    """Format, and the digest of the file that it makes of `sample_events`."""
    for format in FORMATS:
        path = folder / format / "events"
        path.parent.mkdir()
        sample_events().save(path.with_suffix(FORMATS[format]), format=format)
        yield format, file_digest(path.with_suffix(FORMATS[format]))


FORMATS = {
    "hdf5": ".h5",
    "npz": ".npz",
    "ecd": ".txt",
    "evt3": ".raw",
    "dat": ".dat",
    "csv": ".csv",
    "e2vid": ".zip",
    "n-imagenet": ".npz",
    "dsec": ".h5",
    "rosbag1": ".bag",
    "mcap": ".mcap",
    "atis": ".bin",
    "aedat4": ".aedat4",
}
"""Formats whose bytes depend on the events alone, and an extension of each."""


if __name__ == "__main__":
    main()
