"""Masks of pixels: read, and refused where they are something else."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.errors import ConfigError, FileFormatError, InputError, TexventWarning
from texvent.io.pixel_mask import read_pixel_mask
from texvent.sensor import SensorSize

SIZE = SensorSize(5, 3)
MASK = np.zeros((3, 5), bool)
MASK[1, 4] = MASK[2, 0] = True


def write_mask(path: Path, mask: np.ndarray) -> None:
    if path.suffix.lower() == ".png":
        path.write_bytes(cv2.imencode(".png", mask.astype(np.uint8) * 255)[1].tobytes())
    elif path.suffix == ".txt":
        np.savetxt(path, np.argwhere(mask)[:, ::-1], fmt="%d")
    else:
        with path.open("wb") as file:
            np.save(file, mask)


@pytest.mark.parametrize("name", ["hot.npy", "hot.png", "hot.txt", "hot.PNG", "hot.NPY"])
def test_a_mask_is_read(tmp_path, name):
    path = tmp_path / name
    write_mask(path, MASK)
    found = read_pixel_mask(path, SIZE)
    assert found.dtype == np.bool_
    np.testing.assert_array_equal(found, MASK)


def test_a_mask_written_by_hand(tmp_path):
    path = tmp_path / "hot.txt"
    path.write_text("# of my camera\n4 1\n\n0 2  # the corner\n")
    np.testing.assert_array_equal(read_pixel_mask(path, SIZE), MASK)
    path.write_text("5 1\n")
    with pytest.raises(InputError, match=r"line 1: \(5, 1\) lies outside a sensor of 5x3"):
        read_pixel_mask(path, SIZE)
    for text in ("1\n", "1 2 3\n", "a b\n", "-1 2\n", "1.5 2\n"):
        path.write_text(f"0 0\n{text}")
        with pytest.raises(FileFormatError, match=f"line 2: '{text.strip()}' is not a pixel"):
            read_pixel_mask(path, SIZE)


def test_what_is_no_mask_is_refused(tmp_path):
    np.save(tmp_path / "other.npy", MASK.T)
    with pytest.raises(InputError, match=r"mask of shape \(5, 3\); for a sensor of 5x3"):
        read_pixel_mask(tmp_path / "other.npy", SIZE)
    np.save(tmp_path / "float.npy", np.zeros((3, 5)))
    with pytest.raises(FileFormatError, match="holds float64"):
        read_pixel_mask(tmp_path / "float.npy", SIZE)
    (tmp_path / "cut.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    with pytest.raises(FileFormatError, match="cannot be decoded"):
        read_pixel_mask(tmp_path / "cut.png", SIZE)
    (tmp_path / "cut.npy").write_bytes(b"\x93NUMPY")
    with pytest.raises(FileFormatError):
        read_pixel_mask(tmp_path / "cut.npy", SIZE)
    with pytest.raises(ConfigError, match=r"masks end in \.npy, \.png or \.txt"):
        read_pixel_mask(tmp_path / "hot.bmp", SIZE)
    with pytest.raises(InputError, match="no such file"):
        read_pixel_mask(tmp_path / "none.npy", SIZE)


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.diag(np.arange(5, dtype=np.uint8))[:3], "holds 3 levels"),
        (~np.zeros((3, 5), bool), "leaves out 100% of the pixels"),
    ],
)
@pytest.mark.parametrize("ending", [".npy", ".png"])
def test_what_is_perhaps_no_mask_is_warned_of(tmp_path, array, message, ending):
    path = tmp_path / f"mask{ending}"
    if ending == ".png":
        cv2.imwrite(str(path), array.astype(np.uint8))
    else:
        np.save(path, array)
    with pytest.warns(TexventWarning, match=message):
        read_pixel_mask(path, SIZE)
