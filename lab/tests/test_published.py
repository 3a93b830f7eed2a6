"""Numbers of publications are those that their authors give."""

import ast
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

PUBLISHED = {
    # EVREAL, config/dataset/ECD.json.
    "texvent_lab.frame_recordings:EVREAL_SPANS_S": dict.fromkeys(
        ("calibration", "boxes_6dof", "dynamic_6dof", "poster_6dof", "shapes_6dof"), (5.0, 20.0)
    )
    | {"office_zigzag": (5.0, 12.0), "slider_depth": (1.0, 2.5)},
    # CLIP, preprocessing of all its models.
    "texvent_lab.alignment.clip_model:MEAN": (0.48145466, 0.4578275, 0.40821073),
    "texvent_lab.alignment.clip_model:STD": (0.26862954, 0.26130258, 0.27577711),
    # Super SloMo as avinashpaliwal trained it: U-Nets of six levels, a leak of 0.1.
    "texvent_lab.plug_ins.super_slomo:MEAN_COLOUR": (0.429, 0.431, 0.397),
    "texvent_lab.plug_ins.super_slomo:WIDTHS": (32, 64, 128, 256, 512, 512),
    "texvent_lab.plug_ins.super_slomo:SIDES": (7, 5, 3, 3, 3, 3),
    "texvent_lab.plug_ins.super_slomo:PAD_TO": 2**5,
    "texvent_lab.plug_ins.super_slomo:LEAK": 0.1,
    # E2VID and FireNet: channels of the head, bins, sides of its kernels.
    "texvent_lab.reconstruct.recurrent_unet:PUBLISHED_HEAD": (32, 5, 5, 5),
    "texvent_lab.reconstruct.firenet:PUBLISHED_HEAD": (16, 5, 3, 3),
    # The paper's Tables 7 and 10.
    "texvent_lab.bench.reconstruction.run:PAPER_SHARES": (0.01, 0.05, 0.1, 0.2, 0.3),
    "texvent_lab.nt_imagenet.captions:FEWEST_WORDS": 39,
    "texvent_lab.nt_imagenet.captions:MOST_WORDS": 124,
}


def stated(place):
    """The value of a constant, without its module, which may need torch."""
    module, _, name = place.partition(":")
    for one in ast.parse(Path(find_spec(module).origin).read_text("utf-8")).body:
        target = getattr(one, "target", None) or (getattr(one, "targets", None) or [None])[0]
        names = [getattr(each, "id", "") for each in getattr(target, "elts", [target])]
        if name in names:
            value = eval(compile(ast.Expression(one.value), name, "eval"), {})
            return value[names.index(name)] if names[1:] else value
    return None


@pytest.mark.parametrize("place", PUBLISHED)
def test_numbers_of_publications_are_theirs(place):
    assert stated(place) == PUBLISHED[place]


def test_bessel_functions_are_0_at_their_zeros():
    angle = np.linspace(0.0, np.pi, 1001)
    found = stated("texvent_lab.reconstruct.hyper_e2vid:BESSEL_ZEROS")
    for order, zero in found:
        value = np.trapezoid(np.cos(order * angle - zero * np.sin(angle)), angle) / np.pi
        assert abs(value) < 1e-8
    assert [zero for _, zero in found] == sorted(zero for _, zero in found)
