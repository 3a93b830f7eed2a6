"""Tables and arrays that the laboratory reads, where it is installed."""

import json
from dataclasses import asdict
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from .reader import Reader, digest

GRADES = """id,style,nouns_asked,nouns_shown,motion,silently_wrong,fully_right,fully_reported,stand_in,grade,remark
a,short,2,2,yes,no,yes,no,no,5,
b,short,3,1,partly,yes,no,no,no,2,no dog
c,long,1,0,no,0,0,1,1,0,
"""  # noqa: E501  # a row of a table
PROMPTS = "id,prompt,style\na,a red car drives left,short\nb-2,two dogs run,\n"
CAPTIONS = "id,caption\nn01440764_10026,a tench in a  hand\nn01443537_7,a goldfish\n"
IMAGES = np.arange(3 * 28 * 28, dtype=np.uint8).reshape(3, 28, 28)


def lab_readers() -> list[Reader]:
    """One per kind of file."""
    if find_spec("texvent_lab") is None:
        return []
    from texvent_lab.measure.prompts.score import as_markdown, read_grades, sum_grades
    from texvent_lab.measure.prompts.sheet import read_prompts
    from texvent_lab.nt_imagenet.captions import read_captions
    from texvent_lab.nt_imagenet.files import read_captioned

    return [
        Reader("lab grades.csv", partial(_make, GRADES),
               lambda path: as_markdown({"all": sum_grades(read_grades(path))})),
        Reader("lab prompts.csv", partial(_make, PROMPTS), lambda path: repr(read_prompts(path))),
        Reader("lab captions.csv", partial(_make, CAPTIONS),
               lambda path: repr(read_captions(path))),
        Reader("lab captioned.jsonl", _make_captioned,
               lambda path: repr([asdict(one) for one in read_captioned(path)])),
        Reader("lab digits", _make_digits, _read_digits),
    ]  # fmt: skip


def _make(text: str, folder: Path) -> Path:
    path = folder / "table.csv"
    path.write_text(text, encoding="utf-8")
    return path


def _make_captioned(folder: Path) -> Path:
    from texvent_lab.nt_imagenet.files import Captioned

    names = Captioned.__dataclass_fields__
    rows = [{name: f"{name}{number}" for name in names} for number in range(2)]
    path = folder / "captions.jsonl"
    path.write_text("".join(f"{json.dumps(row)}\n" for row in rows), encoding="utf-8")
    return path


def _make_digits(folder: Path) -> Path:
    for kind, values in (("images-idx3", IMAGES), ("labels-idx1", np.array([3, 1, 4], np.uint8))):
        axes = np.array(values.shape, ">u4").tobytes()
        head = bytes((0, 0, 8, values.ndim))
        (folder / f"t10k-{kind}-ubyte").write_bytes(head + axes + values.tobytes())
    return folder


def _read_digits(folder: Path) -> Any:
    from texvent_lab.bench.digits.data import read_mnist

    found = read_mnist(folder)
    return digest([found.images, found.images.shape, found.labels])
