"""Frames of a program: the same events and the same refusals, whichever way they come."""

import itertools
import re
import warnings

import av
import cv2
import numpy as np
import pytest
from PIL import Image

import texvent
from texvent._registry import SIMULATORS
from texvent.errors import InputError, TexventWarning
from texvent.frames import Frame

from .caller_doors import DOORS, OF_IMAGES, ONE_BY_ONE, Stream, through_array

Y, X, T = np.ogrid[:16, :24, :5]
LEVELS = np.moveaxis(np.sin(0.3 * X + 0.2 * Y + 0.4 * T) ** 2 * 250, 2, 0).astype(np.uint8)
UNIT = LEVELS / 255.0
CLEAN = {"noise": "none"}


def named(doors):
    return pytest.mark.parametrize("door", doors, ids=lambda one: one.__name__[8:])


def in_one_buffer(images):
    """Frames that a camera loop writes into one array."""
    buffer = np.empty_like(images[0])
    for image in images:
        buffer[:] = image
        yield buffer
    buffer[:] = 0


WIDE = LEVELS.astype(np.uint16) * np.uint16(257)


RUNS = tuple(itertools.product(SIMULATORS.builtin, ("flow", "blend", "none")))


@pytest.mark.parametrize(("simulator", "interpolate"), RUNS)
def test_one_buffer_for_all_frames_gives_the_events_of_fresh_arrays(simulator, interpolate):
    """Each kind of images through one door; between them the runs pair all kinds with all doors."""
    options = {"simulator": simulator, "interpolate": interpolate, "seed": 1}
    kinds = (LEVELS, WIDE, LEVELS.astype(np.float32), np.stack([LEVELS] * 3, axis=-1))
    for number, images in enumerate(kinds, RUNS.index((simulator, interpolate))):
        door = ONE_BY_ONE[number % len(ONE_BY_ONE)]
        events = through_array(images, **options)
        assert len(events) > 50
        assert door(in_one_buffer(images), **options) == events, door


class Renderer(Stream):
    """A stream that draws any instant, into an array of its own or into one for all."""

    def __init__(self, *, reuses: bool) -> None:
        super().__init__((), is_live=False)
        self._reuses, self._buffer = reuses, np.empty((16, 24), np.float32)

    def at(self, t_us):
        pixels = self._buffer if self._reuses else np.empty((16, 24), np.float32)
        pixels[:] = np.sin(0.3 * X[..., 0] + 0.2 * Y[..., 0] + 4e-5 * t_us) ** 2 * 250
        return Frame(pixels, t_us, is_source=t_us % 10_000 == 0)

    def __iter__(self):
        return (self.at(10_000 * i) for i in range(5))


def test_a_renderer_may_draw_every_instant_into_one_array():
    fresh, reused = (
        texvent.simulate(Renderer(reuses=reuses), interpolate="exact", **CLEAN)
        for reuses in (False, True)
    )
    assert len(fresh) > 50
    assert fresh == reused


def with_one_pixel(level):
    images = UNIT.astype(np.float32)
    images[:, 3, 5] = level
    return images


DOUBTFUL = {
    "0..1": (UNIT, "probably 0..1.*white_level=1"),
    "overshoot of many pixels": (UNIT * 1.04, "probably 0..1.*white_level=1"),
    "a highlight": (with_one_pixel(1.5), "probably 0..1.*white_level=1"),
    "a sun": (with_one_pixel(5e4), "a share of 0.0026 .*probably 0..1.*white_level=1"),
    "a bright pixel": (with_one_pixel(90.0), "may be 0..1 with highlights.*white_level=1"),
    "0..10 of a renderer": (UNIT**4 * 10, "may be 0..1 with highlights.*white_level=1"),
    "masks": ((LEVELS > 128).astype(np.uint8), "probably a mask.*white_level=1"),
    "8 bits in 16": (LEVELS.astype(np.uint16), "probably have 8 bits.*white_level=255"),
    "10 bits": (
        LEVELS.astype(np.uint16) * np.uint16(4),
        "have 10 bits or a few more.*white_level=1023",
    ),
    "12 bits": (LEVELS.astype(np.uint16) * np.uint16(16), "have 12 bits.*white_level=4095"),
    "16 bits in floats": (LEVELS * 257.0, "white_level=65535"),
    **{
        f"floats up to {white:g}": (LEVELS / LEVELS.max() * white, f"white_level={white:g}")
        for white in (1023.0, 4095.0, 65535.0, 90000.0)
    },
    "12 bits in floats": (LEVELS * 16.0 + 0.5, "white_level=4095"),
    "int8": ((LEVELS // 2).astype(np.int8), "int8"),
    "masked": ([np.ma.masked_less(one, 60) for one in LEVELS], "masked value"),
}


def said(door, images, **options):
    """What texvent says of frames: the error, or the warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", TexventWarning)
        try:
            door(images, **CLEAN, **options)
        except InputError as error:
            return [str(error)]
    return [str(one.message) for one in caught]


@named(DOORS)
@pytest.mark.parametrize("what", DOUBTFUL)
def test_pixels_of_another_scale_are_refused_or_said_once_with_the_option(what, door):
    images, words = DOUBTFUL[what]
    if what == "masked" and door not in (*OF_IMAGES, *ONE_BY_ONE):
        images = np.ma.stack(images)
    assert len([one for one in said(door, images) if re.search(words, one)]) == 1


@named(OF_IMAGES)
def test_another_type_of_later_images_is_said(door):
    wide = LEVELS.astype(np.uint16) * np.uint16(257)
    for later, words in ((wide, "uint16, those before it uint8"), (UNIT, "those before|0..1")):
        assert [one for one in said(door, [LEVELS[0], *later[1:]]) if re.search(words, one)]


FADE = np.array([0, 0.003, 0.02, 0.5, 1])[:, None, None]
SOUND = {
    "dark levels in floats": LEVELS // 50 * 1.0,
    "an overexposed video": LEVELS * 1.4,
    "a fade from black": LEVELS * FADE,
    "a fade from black in 8 bits": (LEVELS * FADE).astype(np.uint8),
    "a fade from black in 16 bits": (LEVELS * 257.0 * FADE).astype(np.uint16),
    "a fade from black in 12 bits of 16": (LEVELS * 257.0 * FADE * FADE).astype(np.uint16),
    "black": np.zeros_like(UNIT),
    "half floats": LEVELS.astype(np.float16),
    "booleans": LEVELS > 128,
    "big-endian": (LEVELS * 257.0).astype(">u2"),
    "upside down": LEVELS[:, ::-1, ::-1],
}


@named(DOORS)
@pytest.mark.parametrize("what", SOUND)
def test_sound_pixels_are_taken_without_a_word(what, door):
    assert not [one for one in said(door, SOUND[what]) if "no events" not in one]


@named(DOORS)
@pytest.mark.parametrize("white", [1, 40, 4095])
def test_a_white_level_that_the_pixels_belie_is_said_once(white, door):
    words = said(door, LEVELS if white == 4095 else LEVELS * 1.0, white_level=white)
    found = [one for one in words if f"white_level={white}" in one]
    assert len(found) == 1
    assert "never comes near" in found[0] if white == 4095 else "a share of 0." in found[0]


@named(DOORS)
def test_values_that_cannot_be_light_name_their_remedy(door):
    for images, remedy in (
        (UNIT * 2 - 1, r"\(frames \+ 1\) / 2"),
        (LEVELS - 0.001, r"np\.clip\(frames, 0, None\)"),
        (np.where(LEVELS > 240, np.nan, LEVELS), "nan_to_num"),
        (np.where(LEVELS > 240, np.inf, LEVELS), "nan_to_num"),
        (LEVELS * 1e12, "divide by what is white"),
    ):
        assert re.search(remedy, said(door, images)[-1])


class Exported:
    """An array of another library."""

    def __init__(self, array):
        self.__dlpack__, self.__dlpack_device__ = array.__dlpack__, array.__dlpack_device__


@pytest.mark.parametrize("form", [memoryview, Exported])
def test_a_whole_video_may_be_the_array_of_another_library(form):
    given = form(np.ascontiguousarray(LEVELS))
    assert texvent.simulate(given, fps=100, **CLEAN) == through_array(LEVELS, **CLEAN)


@named(OF_IMAGES)
@pytest.mark.parametrize(
    "form", ["nested lists", "float16", "bool", "channel", "Fortran", "memory", "DLPack"]
)
def test_images_in_any_form_are_taken_alike(form, door):
    forms = {
        "nested lists": [(one * 1.0).tolist() for one in LEVELS],
        "float16": LEVELS.astype(np.float16),
        "bool": LEVELS > 128,
        "channel": LEVELS[..., None],
        "memory": [memoryview(np.ascontiguousarray(one)) for one in LEVELS],
        "DLPack": [Exported(np.ascontiguousarray(one)) for one in LEVELS],
        "Fortran": [np.asfortranarray(one) for one in LEVELS],
    }
    plain = ((LEVELS > 128) * 255).astype(np.uint8) if form == "bool" else LEVELS
    assert door(forms[form], **CLEAN) == through_array(plain, **CLEAN)


PICTURES = [Image.fromarray(one) for one in LEVELS]
MODES = {
    **{mode: (mode,) for mode in ("L", "RGB", "P", "RGBA", "LA", "CMYK", "YCbCr", "HSV", "F")},
    **{"RGBX": ("RGBX",), "PA": ("P", "PA"), "RGBa": ("RGBA", "RGBa")},
}


@named(OF_IMAGES)
@pytest.mark.parametrize("mode", [*MODES, "I;16", "1"])
def test_pictures_of_pillow_are_read_by_the_meaning_of_their_mode(mode, door):
    pictures, levels = list(PICTURES), LEVELS
    for step in MODES.get(mode, ()):
        pictures = [one.convert(step) for one in pictures]
    if mode == "I;16":
        pictures = [Image.fromarray(one.astype(np.uint16) * np.uint16(257)) for one in LEVELS]
    if mode == "1":
        pictures = [Image.fromarray(one > 128) for one in LEVELS]
        levels = ((LEVELS > 128) * 255).astype(np.uint8)
    assert {one.mode for one in pictures} == {mode}
    is_grey = mode in ("L", "LA", "F", "I;16", "1")
    levels = levels if is_grey else np.stack([levels] * 3, axis=-1)
    assert door(pictures, **CLEAN) == through_array(levels, **CLEAN)


@named(OF_IMAGES)
@pytest.mark.parametrize(
    ("images", "words"),
    [
        ([one.convert("I") for one in PICTURES], "pixels of type int32"),
        (["a.png", "b.png"], "is the name 'a.png'.*give the folder"),
        ([av.VideoFrame(24, 16)] * 2, r"is of type VideoFrame.*to_ndarray\(format='rgb24'\)"),
        ([cv2.UMat(one) for one in LEVELS], r"is of type UMat.*image\.get\(\)"),
        ([None, None], "is None, no frame"),
        ([(one, 1) for one in LEVELS], "cannot be read as an array"),
        ([LEVELS[0], LEVELS[1][:9]], "24x9"),
        (LEVELS[..., None].repeat(2, axis=-1), r"got shape .*2\]. Drop .*\[..., 0\]"),
        (LEVELS[..., None].repeat(4, axis=-1), r"got shape .*4\]. Drop .*\[..., :3\]"),
        (LEVELS[:, None].repeat(3, axis=1), r"got shape .*np.moveaxis\(frames, -3, -1\)"),
        ([LEVELS, LEVELS], r"got shape \[5, .*one by one"),
        (LEVELS[:, :0], r"got shape \[0, 24\]"),
    ],
)
def test_what_is_no_image_is_refused_by_its_name(images, words, door):
    with pytest.raises(InputError, match=words):
        door(images, **CLEAN)
