"""MNIST's files, N-MNIST's recordings, how its sensor moved, and digits that move so."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

from texvent.capture.camera_path.motion import DURATION_US, digit_corner
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.run.prepare import prepare_video
from texvent.sensor import SensorSize
from texvent_lab.bench.digits.data import read_idx, read_mnist, read_recordings
from texvent_lab.bench.digits.inputs import polarity_agreement, represent_all
from texvent_lab.bench.digits.plan import find_arm
from texvent_lab.bench.digits.sheet import MEASURED, WIDE, Digits, DigitSheet
from texvent_lab.bench.digits.training import _batches

from .synthetic_data import encode, figures, record, tile_events, write_idx, write_mnist

ONE = np.ones(1)


def corner(t_ms, speed=1.0, amplitude=1.0):
    return digit_corner(1000 * t_ms, speed * ONE, amplitude * ONE)[0]


def test_the_path_rests_at_both_ends_and_scales():
    assert corner(0) == pytest.approx([0.44, 0.52])
    assert corner(310) == pytest.approx(corner(1000))
    assert corner(310) == pytest.approx(corner(0), abs=0.15)  # the camera comes back
    start = corner(0)
    assert corner(150, amplitude=1.2) - start == pytest.approx(1.2 * (corner(150) - start))
    assert corner(100, speed=1.1) == pytest.approx(corner(110))


def slow_render(light, black, x, y):
    """A pixel's mean over its area, in 32×32 samples, of a digit with its corner at (x, y)."""
    samples = (np.arange(34 * 32) + 0.5) / 32
    column, row = np.floor(samples - x).astype(int), np.floor(samples - y).astype(int)
    inside = ((row >= 0) & (row < 28))[:, None] & ((column >= 0) & (column < 28))[None]
    cover = np.where(inside, light[row.clip(0, 27)][:, column.clip(0, 27)], 0.0)
    return black + (255 - black) * cover.reshape(34, 32, 34, 32).mean(axis=(1, 3))


@pytest.mark.parametrize("at_ms", [0, 120, 150])
@pytest.mark.parametrize("field", [{}, {"gamma": 2.2}, {"lead_ms": 17.0}])
def test_pixels_are_means_over_their_area_of_what_every_field_says(field, at_ms):
    images, speed = figures(3, 0), np.array([1.0, 0.9, 1.1])
    shift, amplitude = np.array([[0.25, -0.5], [-1.0, 1.0], [0.0, 0.0]]), np.array([1.2, 1.0, 0.8])
    digits = Digits(images, amplitude, speed, shift, np.array([20.0, 30.0, 40.0]), **field)
    sheet, gamma, lead_ms = DigitSheet(digits), field.get("gamma", 1), field.get("lead_ms", 0)
    tiles = sheet.cut(sheet.at(1000 * at_ms).pixels)
    for number, tile in enumerate(tiles):
        x, y = corner(at_ms + lead_ms, speed[number], amplitude[number]) + shift[number]
        expected = slow_render((images[number] / 255) ** gamma, digits.black[number], x, y)
        # 32 samples know an edge to 1/64 px, of at most 235 levels.
        np.testing.assert_allclose(tile, expected, atol=235 / 32)
        assert abs(tile.mean() - expected.mean()) < 0.1


def test_draws_depend_on_the_seed_and_the_number_of_the_image_alone():
    images, numbers = figures(5, 0), np.array([7, 8, 9, 10, 11])
    whole = Digits.draw(images, numbers, 3)
    part = Digits.draw(images[2:4], numbers[2:4], 3)
    for name in ("amplitude", "speed", "shift", "black"):
        assert np.array_equal(getattr(whole, name)[2:4], getattr(part, name))
    assert not np.array_equal(whole.speed, Digits.draw(images, numbers, 4).speed)


@pytest.mark.parametrize("stimulus", [WIDE, MEASURED])
def test_draws_fill_the_range_of_their_stimulus(stimulus):
    many = Digits.draw(np.zeros((500, 28, 28), np.uint8), np.arange(500), 0, stimulus)
    for found, middle, half in (
        (many.amplitude, 1, stimulus.amplitude),
        (many.speed, 1, stimulus.speed),
        (many.shift, 0, stimulus.shift),
        (many.black / 255, np.mean(stimulus.black), np.ptp(stimulus.black) / 2),
    ):
        part = (found - middle) / half
        assert -1 <= part.min() < -0.97
        assert 0.97 < part.max() <= 1
    chosen = dataclasses.replace(stimulus, gamma=1.7, lead_ms=3.0)
    for one in (Digits.draw(many.images[:1], np.arange(1), 0, chosen),
                Digits.as_measured(many.images[:1], chosen)):  # fmt: skip
        assert (one.gamma, one.lead_ms) == (1.7, 3.0)


@pytest.mark.parametrize("arm", ["esim", "texvent accurate", "frame difference"])
def test_a_digit_has_the_same_events_on_a_sheet_as_alone(arm):
    images = figures(5, 1)
    digits = Digits.draw(images, np.arange(5), 0)
    way = find_arm(arm).ways[0]
    settings = find_arm(arm).settings(way)
    if arm == "texvent accurate":  # its noise is drawn by place
        silent = dataclasses.replace(settings.simulate, noise="none")
        settings = dataclasses.replace(settings, simulate=silent)
    sheet = DigitSheet(digits)
    together = prepare_video(sheet, settings).packets.collect()
    for number in (0, 4):
        one = slice(number, number + 1)
        alone_sheet = DigitSheet(
            Digits(
                images[one],
                digits.amplitude[one],
                digits.speed[one],
                digits.shift[one],
                digits.black[one],
            )
        )
        alone = prepare_video(alone_sheet, settings).packets.collect()
        expected, found = tile_events(alone_sheet, alone, 0), tile_events(sheet, together, number)
        assert len(expected) > 100
        for name in "xytp":
            assert np.array_equal(getattr(found, name), getattr(expected, name)), name


def test_images_of_a_sheet_are_those_of_its_digits():
    sheet = DigitSheet(Digits.as_measured(figures(5, 2)))
    events = prepare_video(sheet, find_arm("texvent paper").settings("exact")).packets.collect()
    images, counts = represent_all(events)
    for number in range(5):
        own, own_counts = represent_all(tile_events(sheet, events, number))
        assert np.array_equal(sheet.cut(counts)[number], own_counts)
        for name, image in own.items():
            assert np.array_equal(sheet.cut(images[name])[number], image), name
            assert image.any()


@pytest.mark.parametrize("count", [1, 255, 256, 700])
def test_counts_of_events_are_whole_and_their_images_end_at_white(count):
    columns = np.full(count, 3), np.full(count, 2), np.arange(count), np.ones(count, int)
    images, counts = represent_all(EventStream(*columns, SensorSize(34, 34)))
    assert counts[:, 2, 3].tolist() == [0, count]
    assert images["histogram"].max() == images["histogram"][:, 2, 3].sum() == min(count, 255)


def test_recordings_laid_out_on_a_sheet_keep_their_events():
    sheet = DigitSheet(Digits.as_measured(figures(3, 0)))
    recorded = record(figures(3, 0))
    together = sheet.lay_out(recorded)
    assert len(together) == sum(map(len, recorded))
    assert (np.diff(together.t) >= 0).all()
    for number, own in enumerate(recorded):
        found = tile_events(sheet, together, number)
        orders = (np.lexsort((one.p, one.x, one.y, one.t)) for one in (found, own))
        for name, (a, b) in zip("xytp", [[*orders]] * 4, strict=True):
            assert np.array_equal(getattr(found, name)[a], getattr(own, name)[b])


def test_polarity_is_checked_against_the_brightness_of_the_digit():
    images = figures(6, 3)
    sheet, recorded = DigitSheet(Digits.as_measured(images)), record(images)
    assert polarity_agreement(sheet, recorded) > 0.97
    opposite = [EventStream(one.x, one.y, one.t, 1 - one.p, one.size) for one in recorded]
    assert polarity_agreement(sheet, opposite) < 0.03
    one_sign = [EventStream(one.x, one.y, one.t, 0 * one.p + 1, one.size) for one in recorded]
    share_on = np.mean(np.concatenate([one.p for one in recorded]))
    assert polarity_agreement(sheet, one_sign) == pytest.approx(share_on, abs=0.1)
    late = EventStream([5], [5], [DURATION_US], [1], SensorSize(34, 34))
    assert math.isnan(polarity_agreement(sheet, [late] * 6))


def test_idx_files_are_read_compressed_or_not(tmp_path):
    values = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)
    for name in ("a-ubyte", "a-ubyte.gz"):
        write_idx(tmp_path / name, values)
        assert np.array_equal(read_idx(tmp_path / name), values)
    images = write_mnist(tmp_path / "mnist", 20)
    found = read_mnist(tmp_path / "mnist")
    assert np.array_equal(found.images, images)
    assert found.labels.tolist() == [*range(10)] * 2


def test_recordings_are_read_with_polarity_flipped(tmp_path):
    for name in ("Train/3/00007.bin", "Test/9/00001.bin"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_bytes(encode([1, 2], [3, 4], [10, 70_000], [1, 0]))
    train, test = read_recordings(tmp_path, [7, 60_001])
    assert (train.label, test.label) == (3, 9)
    events = train.events
    assert events.x.tolist() == [1, 2]
    assert events.y.tolist() == [3, 4]
    assert events.t.tolist() == [10, 70_000]
    assert events.p.tolist() == [0, 1]  # the stored bit is 1 where brightness falls
    with pytest.raises(InputError, match="there is no 00008"):
        read_recordings(tmp_path, [8])


def test_each_epoch_shows_every_image_once_moved_by_at_most_two_pixels():
    images = np.zeros((10, 1, 9, 9), np.uint8)
    images[np.arange(10), 0, 4, 4] = 1 + np.arange(10)
    batches = list(itertools.islice(_batches(images, np.arange(10), 4, seed=3), 60))
    assert [len(labels) for _, labels in batches] == [4, 4, 2] * 20
    places = set()
    for first in range(0, 60, 3):
        labels = np.concatenate([one for _, one in batches[first : first + 3]])
        assert sorted(labels) == list(range(10))
    for shown, labels in batches:
        for image, label in zip(shown, labels, strict=True):
            assert image.max() == 1 + label
            places.add(tuple(np.argwhere(image[0])[0] - 4))
    assert places == {*itertools.product(range(-2, 3), repeat=2)}
