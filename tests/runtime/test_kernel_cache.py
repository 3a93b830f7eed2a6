"""Compiled functions whose files are damaged, or that no folder takes."""

import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "src"
KERNELS = """
from texvent.runtime.jit import jit

@jit
def double(x):
    return 2 * x

print(double(4), sum(double.stats.cache_hits.values()))
"""
NOTICE = "environment variable NUMBA_CACHE_DIR"


@pytest.fixture
def module(tmp_path):
    (tmp_path / "code").mkdir()
    (tmp_path / "temporary").mkdir()
    (tmp_path / "code" / "kernels.py").write_text(KERNELS)
    return tmp_path / "code"


def run(module, **environment):
    """What the kernel returns in a process of its own, how often it came from disk, and stderr."""
    lent = {"PYTHONPATH": f"{module}{os.pathsep}{SOURCE}", "PYTHONDONTWRITEBYTECODE": "1"}
    lent |= {"TMPDIR": str(module.parent / "temporary"), "HOME": str(module.parent)}
    command = [sys.executable, "-c", "import kernels"]
    kept = {name: os.environ[name] for name in os.environ if name != "XDG_CACHE_HOME"}
    done = subprocess.run(
        command, env=kept | lent | environment, capture_output=True, text=True, check=True
    )
    return *map(int, done.stdout.split()), done.stderr


def without_folders(module):
    """Put files where Numba would make its folders: not even root can."""
    (module / "__pycache__").write_text("")
    (module.parent / "no-home").write_text("")
    return {"HOME": str(module.parent / "no-home")}


def kept_in(folder):
    (file,) = folder.rglob("*.nbc")
    return file


def flip(file):
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 0x10
    file.write_bytes(content)


DAMAGE = {
    "empty": lambda file: file.write_bytes(b""),
    "half": lambda file: file.write_bytes(file.read_bytes()[: file.stat().st_size // 2]),
    "a flipped bit": flip,
    "another program's": lambda file: file.write_text("not a kernel"),
    "gone": lambda file: file.unlink(),
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_a_damaged_kernel_is_compiled_anew_and_replaced(module, kind):
    assert run(module) == (8, 0, "")
    DAMAGE[kind](kept_in(module))
    assert run(module) == (8, 0, "")
    assert run(module) == (8, 1, "")


def test_a_folder_in_place_of_a_kernel_does_no_harm(module):
    run(module)
    file = kept_in(module)
    file.unlink()
    (file / "held").mkdir(parents=True)
    result, hits, told = run(module)
    assert (result, hits) == (8, 0)
    assert told.count(NOTICE) == 1


def test_the_folder_that_is_named_is_taken(module, tmp_path):
    named = {"NUMBA_CACHE_DIR": str(tmp_path / "named")}
    assert run(module, **named) == (8, 0, "")
    assert kept_in(tmp_path / "named")
    assert run(module, **named) == (8, 1, "")


def test_without_a_folder_kernels_go_to_a_private_temporary_one_with_one_notice(module):
    bare = without_folders(module)
    result, _, told = run(module, **bare)
    assert result == 8
    assert told.count(NOTICE) == 1
    (folder,) = (module.parent / "temporary").iterdir()
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert run(module, **bare) == (8, 1, "")


@pytest.mark.parametrize("kind", ["open to others", "a link", "a file"])
def test_a_temporary_folder_that_others_may_write_is_not_used(module, kind):
    temporary = module.parent / "temporary"
    planted = temporary / f"texvent-kernels-{os.geteuid()}"
    if kind == "open to others":
        planted.mkdir(0o700)
        planted.chmod(0o777)
    elif kind == "a link":
        (module.parent / "elsewhere").mkdir(0o700)
        planted.symlink_to(module.parent / "elsewhere")
    else:
        planted.write_text("")
    result, hits, told = run(module, **without_folders(module))
    assert (result, hits) == (8, 0)
    assert told.count(NOTICE) == 1
    assert not list(module.parent.rglob("*.nbc"))


def test_without_a_home_no_folder_is_made_where_the_user_stands(module, tmp_path):
    script = f"""
import numba.core.caching as caching, os
os.chdir({str(tmp_path)!r})
os.path.expanduser = lambda path: path
caching.AppDirs = lambda **_: type("Folders", (), {{"user_cache_dir": "~/.cache/numba"}})
import kernels
"""
    (module / "homeless.py").write_text(script)
    environment = os.environ | {"PYTHONPATH": f"{module}{os.pathsep}{SOURCE}"}
    environment |= {"TMPDIR": str(tmp_path / "temporary"), "PYTHONDONTWRITEBYTECODE": "1"}
    (module / "__pycache__").write_text("")
    subprocess.run(
        [sys.executable, "-c", "import homeless"], env=environment, capture_output=True, check=True
    )
    assert not (tmp_path / "~").exists()
