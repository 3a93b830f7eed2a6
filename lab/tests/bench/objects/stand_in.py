"""Files in the layout of the recorded objects, with made-up shapes and noise."""

import cv2
import numpy as np

from texvent_lab.bench.objects.recorded import TABLE_CLASSES, TURNTABLE_FILES

POSES = 4
TABLE = """
name = "table"
truth = ["boxes"]
splits = { train = 1.0 }
options = { duration = 0.4, fps = 20, sensor = "128x128" }

[[sources]]
scene = "scene.toml"
label = "{objects[0].noun}"
count = 2

[sources.vary]
"objects[0].noun" = ["orange", "mug"]
"objects[0].size" = { uniform = [0.9, 1.1] }

[variants.texvent]

[variants.difference]
preset = "paper"
cache = "none"
noise = "none"
timestamp_rule = "end"
"""
SCENE = """
prompt = "a {objects[0].noun}"

[[objects]]
noun = "mug"
motions = [{ kind = "stand" }]

[camera]
position_m = [0, -0.4, 0.2]
look_at_m = [0, 0, 0.05]
moves = [{ kind = "truck", direction = "left", speed_m_s = 0.1 }]

[place]
name = "plain"
"""


def write_specifications(folder):
    folder.mkdir()
    (folder / "scene.toml").write_text(SCENE)
    (folder / "table.toml").write_text(TABLE)
    turntable = TABLE.replace("orange", "cell phone").replace('truth = ["boxes"]', "")
    (folder / "turntable.toml").write_text(turntable)


def write_frames(folder):
    """Bars, one length per class, that move with the pose; every box is 10 px larger."""
    chance = np.random.default_rng(1)
    for name in ("images", "labels"):
        (folder / name).mkdir(parents=True)
    for number, kind in enumerate(TABLE_CLASSES):
        for pose in range(POSES):
            image = np.full((128, 128), 127, np.uint8)
            image[chance.random(image.shape) < 0.05] = 255
            left, width = 20 + 5 * pose, 20 + 8 * number
            image[60:70, left : left + width] = 0
            cv2.imwrite(str(folder / "images" / f"{kind}_{pose}.png"), image)
            sides = (left + width / 2, 65, width + 20, 30)
            line = " ".join(f"{side / 128}" for side in sides)
            (folder / "labels" / f"{kind}_{pose}.txt").write_text(f"{number} {line}")


def write_turntables(folder):
    """1 s of events at random places of a square, one side per class: AEDAT2 as jAER writes it."""
    folder.mkdir()
    chance = np.random.default_rng(2)
    for number, name in enumerate(TURNTABLE_FILES.values()):
        x, y = chance.integers(20, 40 + 10 * number, (2, 2000))
        t, p = np.sort(chance.integers(0, 1_000_000, 2000)), chance.integers(0, 2, 2000)
        address = (127 - y) << 8 | (127 - x) << 1 | (1 - p)
        head = b"#!AER-DAT2.0\r\n# AEChip: ch.unizh.ini.jaer.chip.retina.DVS128\r\n"
        content = np.stack([address, t], axis=1).astype(">u4").tobytes()
        (folder / f"DataSet2_{name}.aedat").write_bytes(head + content)
