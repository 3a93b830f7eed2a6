"""Files are sorted by name as people do, whatever their numbers are."""

import random
from contextlib import nullcontext
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import TexventWarning
from texvent.runtime.files.file_names import in_natural_order, numbering_gap

PLAIN = [
    ["frame2", "frame10", "frame100"],
    ["0.0", "0.05", "0.1", "0.15", "0.2"],  # times, as Python prints them
    ["1305031102.175304", "1305031102.2113", "1305031102.243211", "1305031102.27"],
    ["1.05", "1.10", "1.5"],
    ["0,1", "0,15", "0,2", "0,25"],
    ["t0.1", "t0.15", "t0.2000001", "t1"],
    ["1.8", "1.9", "1.10", "1.11"],  # versions
    ["scene1.2_take9", "scene1.2_take10"],
    ["shot2.0999", "shot2.1000", "shot2.1001"],
    ["2024-01-15", "2024-01-31", "2024-02-01"],
    ["1.2.3", "1.2.10", "1.10.1"],
    ["-1", "-0.5", "0", "0.5", "1"],
    ["t-2", "t-1", "t0", "t1"],
    ["frame-1", "frame-2", "frame-10"],  # a hyphen, not a sign
    ["frame.0001", "frame.0002", "frame.10000"],
    ["a", "b", "c"],
    ["5e-05", "0.0001", "8e-02", "1e-01", "1.5e-01", "2e-01", "1e+00"],
    ["cam0_000012", "cam0_000013", "cam1_000002"],
    ["0_8", "0_9", "0_10", "0_11"],
    ["1700000000_000000099", "1700000000_123456789", "1700000001_000000001"],
    ["2024-01-31_12-00-00", "2024-02-01_01-00-00"],
    ["01-02-2024", "02-02-2024", "03-02-2024"],
    ["clip_9-30-00 am", "clip_10-00-00 am"],
    ["999999999", "1000000000", "1700000000123456789"],
    ["3f2504e0-1", "3f2504e0-2", "3f2504e0-10"],
]
DOUBTFUL = [
    (["left_1", "left_2", "right_1", "right_2"], r"2 patterns of names: left_# \(2\), right_#"),
    (["0b12e", "3f9", "a7c4"], "3 patterns"),
    (["Apr", "Feb", "Jan"], "3 patterns"),
    (["01-02-2024", "31-01-2024"], "days stand before years"),
    (["clip 02.11.2023", "clip 11.02.2022"], "days stand before years"),
    (["1-00-00 pm", "12-59-58 pm"], "am and pm"),
    (["0_1", "0_2", "0_15"], "counted or decimals"),
    (["t0p1", "t0p2", "t0p15"], "counted or decimals"),
    (["frame0-1", "frame0-2", "frame0-15"], "counted or decimals"),
    (["0_1", "0_2", "0_05", "0_15"], "counted or decimals"),
]


WITH_COMMAS = [[stem.replace(".", ",") for stem in one] for one in PLAIN if "." in "".join(one)]


@pytest.mark.parametrize(
    ("stems", "doubt"), [(one, None) for one in (*PLAIN, *WITH_COMMAS)] + DOUBTFUL
)
def test_names_are_sorted_by_the_numbers_in_them(stems, doubt):
    paths = [Path("f") / f"{stem}.png" for stem in stems]
    mixed = random.Random(1).sample(paths, len(paths))
    with pytest.warns(TexventWarning, match=doubt) if doubt else nullcontext() as said:
        assert in_natural_order(mixed) == paths
    if doubt:
        assert len(said) == 1


@given(st.integers(2, 5), st.sampled_from([0, 1]), st.integers(0, 1), st.data())
def test_numbers_of_a_camera_that_start_again_are_said(width, first, dropped, data):
    full = 10**width
    begin = data.draw(st.integers(first + 1, full - 1))
    last = begin + data.draw(st.integers(1, (full - first) // 2 - 2))
    taken = [first + (one - first) % (full - first) for one in range(begin, last + 1)]
    starts_again = last >= full
    lost = {full - 1} if dropped and starts_again and begin < full - 1 else set()
    paths = [Path(f"DSC_{one:0{width}}.png") for one in sorted({*taken} - lost)]
    said = rf"start again behind DSC_{full - 1 - len(lost)}\.png"
    with pytest.warns(TexventWarning, match=said) if starts_again else nullcontext():
        assert in_natural_order(paths) == paths
        assert numbering_gap(paths) is None


def test_two_images_of_one_number_are_said():
    with pytest.warns(TexventWarning, match=r"frame#.jpg \(1\)"):
        in_natural_order([Path("frame1.png"), Path("frame1.jpg")])


@pytest.mark.parametrize(
    ("numbers", "gap"),
    [
        ([0, 1, 2, 5, 6, 7], "f2.png and f5.png"),
        ([0, 10, 20, 40, 50], "f20.png and f40.png"),
        ([0, 1, 2, 3], None),
        ([0, 33, 67, 100], None),  # times
        ([3], None),
    ],
)
def test_a_gap_in_a_regular_numbering_is_found(numbers, gap):
    assert numbering_gap([Path(f"f{number}.png") for number in numbers]) == gap
