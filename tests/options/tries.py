"""Values to try of options, where type, default and choices do not say which have an effect."""

from __future__ import annotations

from typing import NamedTuple

from texvent._registry import SIMULATORS
from texvent.settings.presets import presets_by_simulator


class Try(NamedTuple):
    """Another value, which must change something."""

    words: str
    beside: str = ""
    """Words of both runs."""
    changes: str = ""
    """Part of `Outcome`; without it, that of the command."""
    base: str | None = None
    """Command line of both runs, in place of that of the table."""
    before: str = ""
    """Command line of a run before both, in the same folder; "BASE": that without the option."""


class Rise(NamedTuple):
    """Two values: a figure is larger with the second one, as the help says."""

    low: str
    high: str
    measure: str = "count"
    beside: str = ""
    base: str | None = None


class Command(NamedTuple):
    """A run to which options are added."""

    words: str
    changes: str = "events"
    """Part of `Outcome` that its options change."""
    shared: tuple[str, ...] = ()
    """Options, or sections of its help, that another command tries."""


READING = ("sensor", "time-unit", "columns", "stream", "repair", "format")
SIMULATION = ("run", "interpolate", "simulate")
CLIP = "simulate ../clip.npy --fps 5 --previews none -o o.npz"
FRAMES = "simulate ../frames --previews none -o o.npz"
FILM = "simulate ../film.npy --fps 25 --previews none --noise none -o o.npz"
MOTION = "--motion ../forward.npy --interpolate motion"
STILL = "simulate ../still.png --sensor 16x12 --previews none -o o.npz"
SMALL = "--sensor 16x12 --duration 0.125 --samples 1 --previews none"
SCENE = f"generate 'a red ball bounces in a room' {SMALL}"
BATCH = f"batch ../prompts.txt {SMALL} --format npz"
RIG = "rig 'a red ball bounces in a room' --sensor 16x12 --duration 0.125 --samples 1"
REST = "calibrate --events ../rest.npz -o o.toml"
FLICKER = "calibrate --events ../flicker.npz --flicker-hz 5 -o o.toml"
MOVING = "calibrate --frames ../moving.npy --fps 50 --events ../moving.npz --seconds 0.1 --interpolate none -o o.toml"
CONVERT = "convert ../events.h5 o.npz"
EVENTS = "../events.h5"
COMMANDS_TRIED: dict[str, Command] = {
    "simulate": Command(CLIP, shared=("simulate",)),
    **{
        f"simulate --simulator {one}": Command(
            f"{CLIP} --simulator {one}",
            shared=("input", "output", "run", "capture", "interpolate"),
        )
        for one in SIMULATORS.builtin
    },
    "generate": Command(f"{SCENE} -o o.npz", shared=("keep-partial", *SIMULATION)),
    "batch": Command(BATCH, shared=("shadows", "hdr", "samples", *SIMULATION)),
    "rig": Command(RIG, "files", shared=("shadows", "hdr", "samples", *SIMULATION)),
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
NOISE = "--noise-rate-hz 5"
TRIES: dict[str, Try | Rise | list[Try | Rise]] = {
    # What a run writes and says.
    "--prompt": Try("--prompt 'a ball'", changes="facts"),
    "--out": Try("--out other.npz", changes="names"),
    "--format": Try("--format npz", base=CLIP.partition(" -o")[0], changes="names"),
    "generate --format": Try("--format npz", base=SCENE, changes="names"),
    "--previews": [Try(f"--previews {one}", changes="names") for one in ("png", "html,png")],
    "simulate --truth": Try("--truth flow", MOTION, changes="names", base=FILM),
    "--overwrite": Try("--overwrite", changes="code", before="BASE"),
    "--config": Try("--config ../options.toml"),
    "--print-config": Try("--print-config", changes="printed"),
    "--dry-run": Try("--dry-run", changes="printed"),
    "--quiet": Try("--quiet", changes="said"),
    # Run.
    "--simulator": [Try(f"--simulator {one}") for one in list(SIMULATORS.builtin)[1:]],
    "--preset": [
        Try(f"--preset {one}") for one in presets_by_simulator()[next(iter(SIMULATORS.builtin))][1:]
    ],
    "--sensor": Rise("--sensor 8x6", "--sensor 16x12", "pixels"),
    "--seed": Try("--seed 1"),
    "--label-noise": Try("--label-noise"),
    "--target-rate": Rise("--target-rate 200", "--target-rate 2000"),
    # Frames.
    "--fps": Rise("--fps 10", "--fps 5", "last"),
    "--timestamps": Try("--timestamps ../seconds.txt", changes="code", base=FRAMES),
    "--timestamps-unit": Rise(
        "--timestamps-unit ms",
        "--timestamps-unit s",
        "last",
        "--timestamps ../times.txt",
        base=FRAMES,
    ),
    "--start": Rise("--start 0", "--start 0.3", "first"),
    "--stop": Rise("--stop 0.3", "--stop 0.7", "last"),
    "--white-level": Rise("--white-level 1000", "--white-level 255"),
    "--transfer": [Try(f"--transfer {one}") for one in ("srgb", "linear", "pq", "hlg")],
    "--fit": [Try(f"--fit {one}", "--sensor 12x12") for one in ("contain", "stretch")],
    "--motion": Try(MOTION, "--interpolate blend", base=FILM),
    "--motion-back": Try("--motion-back ../backward.npy", MOTION, base=FILM),
    "--motion-convention": Try(
        "--motion-convention backward,px", f"{MOTION} --no-check-motion", base=FILM
    ),
    "simulate --check-motion": Try(
        "--no-check-motion", "--motion ../backward.npy", changes="code", base=FILM
    ),
    "--depth": Try("--depth ../depth.npy", MOTION, base=FILM),
    "--depth-scale": Try(
        "--depth-scale 0.001",
        f"{MOTION} --depth ../depth.npy --truth depth",
        changes="files",
        base=FILM,
    ),
    "--instances": Try(
        "--instances ../instances.npy", f"{MOTION} --truth ids", changes="code", base=FILM
    ),
    "--camera": [
        Try(f"--camera {one}", "--camera saccade", base=STILL) for one in ("shake", "pan")
    ],
    "--camera-amplitude": Rise(
        "--camera-amplitude 10",
        "--camera-amplitude 80",
        "count",
        "--camera pan --duration 0.1",
        STILL,
    ),
    "simulate --duration": Rise("--duration 0.05", "--duration 0.1", "last", "--camera pan", STILL),
    # Intermediate frames.
    "--interpolate": [Try(f"--interpolate {one}") for one in ("none", "blend")],
    "--fixed-count": Rise("--fixed-count 1", "--fixed-count 6", r"\+ ([\d,]+) intermediate"),
    "--max-intermediate": Rise(
        "--max-intermediate 1",
        "--max-intermediate 9",
        r"\+ ([\d,]+) intermediate",
        "--interpolate blend",
    ),
    "--frames-per-pixel": Rise(
        "--frames-per-pixel 0", "--frames-per-pixel 4", r"\+ ([\d,]+) intermediate"
    ),
    "--deflicker": Try("--deflicker", base=CLIP.replace("clip", "flickering")),
    "--detect-cuts": Try("--no-detect-cuts", base=FILM.replace("film", "cut")),
    # Pixel models.
    "--contrast-threshold": Rise("--contrast-threshold 0.4", "--contrast-threshold 0.15"),
    "--contrast-threshold-on": Rise(
        "--contrast-threshold-on 0.4", "--contrast-threshold-on 0.15", "on"
    ),
    "--contrast-threshold-off": Rise(
        "--contrast-threshold-off 0.4", "--contrast-threshold-off 0.15", "off"
    ),
    "--balance": Rise("--balance 60", "--balance 5"),
    "--log-eps": Rise("--log-eps 0.3", "--log-eps 0.01"),
    "--gamma": Rise("--gamma 1", "--gamma 3"),
    "--residual-decay-hz": Rise(
        "--residual-decay-hz 20", "--residual-decay-hz 0.01", "count", "--noise none"
    ),
    "--timestamp-rule": [
        *(Try(f"--timestamp-rule {one}") for one in ("random", "end")),
        Try("--timestamp-rule eq7", "--no-multi-event"),
    ],
    "--noise-rate-hz": Rise("--noise-rate-hz 0.1", "--noise-rate-hz 5"),
    "--noise-scale": Rise("--noise-scale 0.1", "--noise-scale 4"),
    "--noise-intensity": Rise("--noise-intensity 10", "--noise-intensity 200", "count", NOISE),
    "--noise-on-fraction": Rise(
        "--noise-on-fraction 0.1", "--noise-on-fraction 0.9", "share of ON"
    ),
    "--noise-curve": Rise("--noise-curve '1:0.1 50:0.1'", "--noise-curve '1:9 50:9'"),
    "--noise-decades": Rise(
        "--noise-decades 0", "--noise-decades 1", "spread", "--noise-curve '1:9 50:9'"
    ),
    "--shot-noise-rate-hz": Rise("--shot-noise-rate-hz 0", "--shot-noise-rate-hz 9"),
    "--threshold-sigma": Rise("--threshold-sigma 0", "--threshold-sigma 0.3", "spread"),
    "--threshold-map": Try("--threshold-map ../map.npz"),
    "--on-off-ratio": Rise("--on-off-ratio 3", "--on-off-ratio 0.3", "share of ON"),
    "--cutoff-hz": Rise("--cutoff-hz 1", "--cutoff-hz 100"),
    "--cutoff-limit-hz": Rise("--cutoff-limit-hz 0.2", "--cutoff-limit-hz 20"),
    "--refractory-period-us": Rise("--refractory-period-us 200000", "--refractory-period-us 0"),
    "--leak-rate-hz": Rise("--leak-rate-hz 0", "--leak-rate-hz 9", "on"),
    "--leak-rate-decades": Try("--leak-rate-decades 0.5", "--leak-rate-hz 9"),
    "--hot-pixel-fraction": Rise("--hot-pixel-fraction 0", "--hot-pixel-fraction 0.3"),
    "--hot-pixel-rate-hz": Rise(
        "--hot-pixel-rate-hz 1", "--hot-pixel-rate-hz 90", "count", "--hot-pixel-fraction 0.3"
    ),
    "--sensor-seed": Try("--sensor-seed 1"),
    "--scan-period-ns": Rise("--scan-period-ns 50000000", "--scan-period-ns 1000000"),
    "--constants": Try("--constants '5 20 1e-4 1e-7 5e-9 1e-5'"),
    # Scenes.
    "generate --out": Try("--out other.npz", base=SCENE, changes="names"),
    "generate --generator": Try("--generator opensora", changes="code"),
    "--video-only": Try("--video-only", base=f"{SCENE} -q", changes="names"),
    "--preview": Try("--preview p.png", base=SCENE, changes="names"),
    "--write-scene": Try("--write-scene s.toml", base=SCENE, changes="names"),
    "generate --dry-run": Try("--dry-run", base=SCENE, changes="names"),
    "--truth": Try("--truth flow", changes="names"),
    "generate --fps": Rise("--fps 16", "--fps 80", r"(\d+) source"),
    "--duration": Rise("--duration 0.1", "--duration 0.2", "last"),
    "--samples": Try("--samples 3"),
    "generate --assets": Try(
        "--assets ../assets", base=f"generate 'a magic wand' {SMALL} -o o.npz", changes="code"
    ),
    "generate --shadows": Try(
        "--no-shadows", base=f"generate 'a red cube jumps on a sunny day' {SMALL} -o o.npz"
    ),
    "generate --strict": Try(
        "--strict", base=f"generate 'a wug and a dog run' {SMALL} -o o.npz", changes="code"
    ),
    # Many of them.
    "batch --out": Try("--out other", changes="names"),
    "batch --format": Try("--format hdf5", changes="names"),
    "batch --generator": Try("--generator opensora", changes="code"),
    "batch --overwrite": Try("--overwrite", "--seed 4", changes="code", before=BATCH),
    "batch --jobs": Try("--jobs 0", changes="code"),
    "batch --keep-partial": Try("--keep-partial", changes="code"),
    "batch --assets": Try(
        "--assets ../assets", base=BATCH.replace("prompts", "wand"), changes="code"
    ),
    "batch --strict": Try("--strict", base=BATCH.replace("prompts", "wug"), changes="code"),
    "batch --fps": Try("--fps 80"),
    # Rigs.
    "rig --rig": Try(
        "--rig ../rig.yaml", base="rig 'a red ball bounces in a room' --duration 0.125 --samples 1"
    ),
    "rig --stereo": Try("--stereo 0.1"),
    "rig --frames": Rise("--frames 8", "--frames 40", "files"),
    "rig --exposure": Try("--exposure 0.02", "--frames 24"),
    "rig --shutter": Try("--shutter rolling", "--frames 24"),
    "rig --readout": Try("--readout 0.03", "--frames 24 --shutter rolling"),
    "rig --layout": [
        Try(f"--layout {one}", "--stereo 0.1", changes="names")
        for one in ("dsec", "rosbag1", "mcap")
    ],
    "rig --imu": Rise("--imu 20", "--imu 900", "bytes"),
    "rig --imu-noise": Try("--imu-noise none", "--imu 100"),
    "rig --out": Try("--out other", changes="names"),
    "rig --truth": Try("--truth flow"),
    "rig --fps": Try("--fps 60"),
    "rig --duration": Rise("--duration 0.1", "--duration 0.2", "bytes"),
    "rig --assets": Try(
        "--assets ../assets",
        base="rig 'a magic wand' --sensor 16x12 --duration 0.125",
        changes="code",
    ),
    "rig --strict": Try(
        "--strict", base="rig 'a wug and a dog run' --sensor 16x12 --duration 0.125", changes="code"
    ),
    # Checks of videos.
    "check --all": Try("--all", base="check ../clip.npy --fps 5"),
    "check --json": Try("--json", base="check ../clip.npy --fps 5"),
    "check --strict": Try("--strict", base="check ../cut.npy --fps 5", changes="code"),
    "check --fps": Rise("--fps 5", "--fps 50", r'"fps": ([\d.]+)'),
    "check --start": Rise("--start 0.5", "--start 0", r'"frames": ([\d.]+)'),
    "check --stop": Rise("--stop 0.5", "--stop 0.7", r'"frames": ([\d.]+)'),
    "check --white-level": Try("--white-level 100"),
    "check --timestamps": Try(
        "--timestamps ../seconds.txt", base="check ../frames", changes="code"
    ),
    "check --timestamps-unit": Rise(
        "--timestamps-unit s",
        "--timestamps-unit ms",
        r'"fps": ([\d.]+)',
        "--timestamps ../times.txt",
        base="check ../frames --json",
    ),
    # Calibration.
    "calibrate --frames": Try(
        "--frames ../moving.npy --fps 50 --interpolate none", "--events ../moving.npz --seconds 0.1"
    ),
    "calibrate --events": Try("--events ../calm.npz"),
    "calibrate --flicker-hz": Try("--flicker-hz 5", "--events ../flicker.npz", changes="code"),
    "calibrate --flicker-ratio": Try("--flicker-ratio 6", base=FLICKER),
    "calibrate --threshold-map": Try("--threshold-map m.npz", base=FLICKER, changes="files"),
    "calibrate --sensor": Try("--sensor 20x20", "--events ../rest.csv", changes="code"),
    "calibrate --format": Try("--format dat", "--events ../rest.csv", changes="code"),
    "calibrate --start-preset": Try("--start-preset davis346", changes="files"),
    "calibrate --frames-gamma": Try("--frames-gamma 2.2", base=MOVING),
    "calibrate --keep": [Try(f"--keep {one}", base=MOVING) for one in ("balance", "cutoff_hz")],
    "calibrate --seconds": Try("--seconds 0.2", base=MOVING),
    "calibrate --out": Try("--out other.toml", changes="names"),
    "calibrate --overwrite": Try("--overwrite", changes="code", before="BASE"),
    # Event files.
    "--time-unit": [
        Try(f"--time-unit {one}", base="convert ../plain.csv o.npz --sensor 16x12")
        for one in ("s", "ms", "ns")
    ],
    "--columns": Try("--columns y,x,t,p", base="convert ../odd.csv o.npz --sensor 16x16"),
    "--repair": Try("--repair", base="convert ../damaged.csv o.npz --sensor 16x12", changes="code"),
    "--stream": Try(
        "--stream left", base="convert ../several.h5 o.npz --sensor 16x12", changes="code"
    ),
    "convert --sensor": Try("--sensor 16x12", base="convert ../plain.csv o.npz", changes="code"),
    "convert --out": Try("--out o.npz", base=f"convert {EVENTS}", changes="code"),
    "convert --format": Try("--format hdf5", base=f"convert {EVENTS} o.npz", changes="code"),
    "convert --from-format": Try(
        "--from-format dat", base="convert ../plain.csv o.npz --sensor 16x12", changes="code"
    ),
    "convert --merge": Rise("", "--merge ../others.h5"),
    "convert --mask": Rise("--mask ../mask.txt", ""),
    "convert --filter": [
        Rise(f"--filter {one}", "")
        for one in (
            "refractory:period_us=200000",
            "background-activity",
            "rate-limit:rate_hz=100,window_us=20000",
        )
    ],
    "convert --undistort": Try("--undistort ../lens.txt"),
    "convert --crop": Rise("--crop 2,2,8,8", "--crop 1,1,12,10"),
    "convert --resize": Rise("--resize 8x6", "--resize 16x12", "pixels"),
    "convert --rotate": [Try(f"--rotate {one}") for one in (90, 180, 270)],
    "convert --flip": [Try(f"--flip {one}") for one in ("x", "y", "xy")],
    "convert --from-zero": Try("--from-zero"),
    "--time": Try("--time 0.2,0.5"),
    "convert --split": Try(
        "--split ../parts.txt", changes="names", base=f"convert {EVENTS} o --format npz"
    ),
    "convert --video": Try(
        "--video ../scene.avi",
        "--format event-utils",
        base=f"convert {EVENTS} o.hdf5",
        changes="files",
    ),
    "convert --quiet": Try("--quiet", changes="printed"),
    "render --quiet": Try("--quiet", changes="printed"),
    "view --quiet": Try("--quiet", changes="printed"),
    "validate --quiet": Try("--quiet", changes="printed"),
    "render --out": Try("--out other.png", changes="names"),
    "render --video": Try("--video none", base="render ../scene.h5 -o o.png"),
    "render --render-fps": Rise(
        "--render-fps 10", "--render-fps 60", "bytes", base=f"render {EVENTS} -o o.gif"
    ),
    "render --window": Try("--window 200"),
    "render --events-per-image": Try("--events-per-image 20"),
    "render --speed": Rise("--speed 4", "--speed 0.5", "bytes", base=f"render {EVENTS} -o o.gif"),
    "--palette": Try("--palette redblue"),
    "render --overlay": [
        Try(f"--overlay {one}", base="render ../scene.h5 -o o.png")
        for one in ("boxes", "flow", "both")
    ],
    "--points": Rise("--points 20", "--points 90", "bytes", base="BASE ../events.h5 -o o.html"),
    "view --out": Try("--out other.html", changes="names"),
    "view --video": Try("--video none", base="view ../scene.h5 -o o.html"),
    "info --fps": Try("--fps 30", base="info ../frames", changes="code"),
    "compare --metrics": Try("--metrics stpp"),
    # Data sets.
    "compare --rvt-weights": Try("--rvt-weights ../mask.txt", changes="code"),
    "dataset plan --trial": Try("--trial 1"),
    "dataset make --out": Try("--out other"),
    "dataset make --shards": [Try(f"--shards {one}/2") for one in (1, 2)],
    "dataset sample --count": Rise("--count 1", "--count 4", "bytes"),
    "dataset sample --variant": Try("--variant esim"),
    "dataset sample --split": Try("--split test"),
    "dataset sample --label": Try("--label bus"),
    "dataset sample --out": Try("--out other.html", changes="names"),
    "dataset sample --seed": Try("--seed 1", "--count 2"),
    "dataset make --workers": Try("--workers 0", changes="code"),
    "dataset make --ray": Try("--ray nowhere:1", changes="code"),
    "dataset make --retry-failed": Try(
        "--retry-failed",
        changes="said",
        base="dataset make ../wugs.toml -o cars --workers 1",
        before="BASE",
    ),
    "dataset make --allow-failed": Try(
        "--allow-failed", changes="code", base="dataset make ../wugs.toml -o cars --workers 1"
    ),
    "dataset make --quiet": Try("--quiet", changes="said"),
    "dataset verify --workers": Try("--workers 0", changes="code"),
    "dataset verify --no-contents": Try("--no-contents"),
    "dataset sample --overwrite": Try("--overwrite", changes="code", before="BASE"),
    "dataset export --layout": Try("--layout n-caltech101"),
    "dataset export --out": Try("--out other"),
    "dataset export --variant": Try("--variant esim", changes="files"),
    "dataset export --classes": Try(
        "--classes car",
        "--layout coco",
        changes="files",
        base="dataset export ../cars -o o --variant paper",
    ),
    "scenes --assets": Try("--assets ../assets"),
}
ELSEWHERE: dict[tuple[str, str], str] = {
    ("simulate", "keep-partial"): "tests/cli/test_nothing_lost.py",
    ("simulate", "interpolator-weights"): "tests/interpolate/rife",
    ("convert", "frames"): "tests/capture/test_aedat4_frames.py",
    ("convert", "triggers"): "tests/io/test_side_data.py",
    ("convert", "imu"): "tests/io/test_side_data.py",
    ("generate", "llm-url"): "tests/scenes/llm/test_llm.py",
    ("generate", "llm-model"): "tests/scenes/llm/test_llm.py",
}
"""(command, option) → the tests that show its effect, which needs more than a small run."""
