"""Configs, lists, times, calibrations, words of a command line; network weights without torch."""

import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w
import yaml

from texvent._registry import FILTERS
from texvent.capture.given_times import read_timestamps
from texvent.cli.event_files.event_file_options import parse_time_range
from texvent.dataset.specification.list_files import read_list
from texvent.io.calibration import read_calibration
from texvent.io.pixel_mask import EXTENSIONS, read_pixel_mask
from texvent.metrics.lpips import read_lpips_weights, write_lpips_weights
from texvent.options.values import make_part
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.truth.labels import read_labels
from texvent_scenes.scene_input import describe_scene, list_nouns, understand
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.files import load_scene, scene_text
from texvent_scenes.staging.compose import compose_scene

from ..io.test_pixel_mask import write_mask
from ..metrics.lpips.lpips_files import NARROW, narrow_weights, write_published
from .reader import Reader, digest

CONFIG = {
    "run": {"simulator": "physical", "preset": "davis346", "sensor": "davis346", "seed": 3},
    "interpolate": {"interpolate": "blend", "max_intermediate": 8, "deflicker": False},
    "capture": {"fps": "30000/1001", "start": 0.5, "stop": 2.0, "fit": "cover"},
}
LISTS = {
    ".txt": "# prompts\na red car drives left\n\na dog runs\n",
    ".csv": 'prompt,video,name,seed\n"a car, red",,one,3\na dog,clip.mp4,two,\n',
    ".jsonl": '{"prompt": "a car", "name": "a", "seed": 7}\n"a dog"\n{"video": "clip.mp4"}\n',
}
YOLO = "clip_1.txt"
"""In a folder of one frame."""
_COCO: dict[str, Any] = {
    "images": [{"id": 1, "width": 40, "height": 20}],
    "categories": [{"id": 3, "name": "car"}],
    "annotations": [{"image_id": 1, "category_id": 3, "bbox": [4, 2, 8, 6.5], "track_id": 7}],
}
LABELS = {
    "labels.json": json.dumps(_COCO),
    "labels.txt": "1,1,5,3,8,6.5,1,3,1\n2,1,6,3,8,6,1,3,1\n",
    YOLO: "2 0.5 0.5 0.2 0.25\n",
}
MASK_SIZE = SensorSize(12, 9)
TEXTS: dict[str, tuple[str, Any]] = {
    "filter": ("background-activity:window_us=5000,support=2", partial(make_part, FILTERS)),
    "time": ("0.5,2", parse_time_range),
    "prompt": ("a red car drives left past two trees at dusk", lambda text: _stage(text)),
    "preset": ("paper", lambda text: resolve("simulate", {"preset": text})),
    "fps": ("30000/1001", lambda text: resolve("simulate", {"fps": text})),
}


SCENE = {
    "objects": [
        {"noun": "car", "colour": "red", "position_m": [1, 2], "motions": [{"kind": "drive"}]},
        {"noun": "tree", "count": 2, "relations": [{"kind": "behind", "to": ["car"]}]},
        {"noun": "tv", "picture": {"kind": "checkerboard", "value": "9x6"}},
    ],
    "camera": {"position_m": [0, -9, 2], "look_at_m": [0, 0, 1]},
    "light": {"kind": "dusk", "flicker_hz": 100.0},
}


def text_readers() -> list[Reader]:
    """One per kind of text."""
    return [
        *(
            Reader(f"config {ending}", partial(_make_config, ending), _read_config)
            for ending in (".toml", ".yaml")
        ),
        *(
            Reader(f"scene {ending}", partial(_make_scene, ending), _read_scene)
            for ending in (".toml", ".json")
        ),
        *(
            Reader(f"list {ending}", partial(_make_text, f"list{ending}", text), _read_list)
            for ending, text in LISTS.items()
        ),
        Reader(
            "timestamps",
            partial(_make_text, "timestamps.txt", "# s\n0.0 a.png\n0.04 b.png\n0.08 c.png\n"),
            lambda path: repr(read_timestamps(path, "s")),
        ),
        Reader(
            "calibration",
            partial(_make_text, "calib.txt", "199.1 198.8 132.2 110.7 -0.37 0.15 0.0 0.0 0.0\n"),
            lambda path: repr(read_calibration(path)),
        ),
        *(
            Reader(f"pixel mask {ending}", partial(_make_mask, ending), _read_mask)
            for ending in EXTENSIONS
        ),
        *(
            Reader(f"option {name}", partial(_make_text, "option.txt", text), partial(_read, parse))
            for name, (text, parse) in TEXTS.items()
        ),
        *(
            Reader(f"labels {name}", partial(_make_text, name, text), partial(_read_labels, name))
            for name, text in LABELS.items()
        ),
        Reader("weights .npz", _make_weights, _read_weights),
        Reader("weights pickle", _make_published, _read_weights),
    ]


def _make_text(name: str, text: str, folder: Path) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def _read(parse: Any, path: Path) -> str:
    """The text as a command gets it: bytes that are not UTF-8 as surrogates."""
    text = path.read_bytes().decode("utf-8", "surrogateescape")
    return repr(parse(text))[:1000]


def _stage(text: str) -> Any:
    return compose_scene(
        understand(text, list_nouns()), seed=0, size=SensorSize(64, 48), duration_s=1.0
    )


def _make_config(ending: str, folder: Path) -> Path:
    text = tomli_w.dumps(CONFIG) if ending == ".toml" else yaml.safe_dump(CONFIG)
    return _make_text(f"run{ending}", text, folder)


def _read_config(path: Path) -> str:
    return repr(resolve("simulate", {}, config=path).as_tables())[:1000]


def _make_scene(ending: str, folder: Path) -> Path:
    return _make_text(f"scene{ending}", scene_text(scene_from_data(SCENE), ending), folder)


def _read_scene(path: Path) -> str:
    return repr(describe_scene(load_scene(path), list_nouns()))[:1000]


def _read_labels(name: str, path: Path) -> str:
    labels = read_labels(path.parent if name == YOLO else path, SensorSize(40, 20))
    return digest([labels.boxes.tobytes(), labels.frames, labels.names])


def _read_list(path: Path) -> str:
    return repr(read_list(path)).replace(str(path.parent), "")[:1000]


def _make_mask(ending: str, folder: Path) -> Path:
    path = folder / f"mask{ending}"
    mask = np.random.default_rng(0).random(MASK_SIZE.shape) < 0.2
    write_mask(path, mask)
    return path


def _read_mask(path: Path) -> str:
    return repr(read_pixel_mask(path, MASK_SIZE).tolist())


def _make_weights(folder: Path) -> Path:
    write_lpips_weights(narrow_weights(), folder / "alex.npz")
    return folder / "alex.npz"


def _make_published(folder: Path) -> Path:
    return write_published(narrow_weights(), folder / "weights_v0.1")


def _read_weights(path: Path) -> str:
    arrays = read_lpips_weights(path, NARROW)
    return digest(arrays[name] for name in sorted(arrays))
