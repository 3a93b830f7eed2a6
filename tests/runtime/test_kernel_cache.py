"""Compiled functions whose files are damaged, or that no folder takes."""

import itertools
import os
import runpy
import stat
import subprocess
import sys
import tempfile
import warnings
from functools import partial
from pathlib import Path

import numba
import pytest

from texvent.runtime import jit

SOURCE = Path(__file__).parents[2] / "src"
KERNELS = """
from texvent.runtime.jit import jit

@jit
def double(x):
    return 2 * x

FOUND = double(4), sum(double.stats.cache_hits.values())
"""
NOTICE = "environment variable NUMBA_CACHE_DIR"


@pytest.fixture
def module(tmp_path):
    (tmp_path / "code").mkdir()
    (tmp_path / "temporary").mkdir()
    (tmp_path / "code" / "kernels.py").write_text(KERNELS)
    return tmp_path / "code"


def run(module, **environment):
    """What the kernel returns, how often it came from disk, and what is said: as in a new process.

    A module that is run anew has a function and a cache of its own.
    """
    lent = {"TMPDIR": str(module.parent / "temporary"), "HOME": str(module.parent)} | environment
    with pytest.MonkeyPatch.context() as patch, warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        patch.delenv("XDG_CACHE_HOME", raising=False)
        for name, value in lent.items():
            patch.setenv(name, value)
        patch.setattr(tempfile, "tempdir", None)
        patch.setattr(numba.config, "CACHE_DIR", environment.get("NUMBA_CACHE_DIR", ""))
        patch.setattr(jit, "_NOTICES", itertools.count())
        found = runpy.run_path(str(module / "kernels.py"), run_name="kernels")
    return *found["FOUND"], "".join(str(one.message) for one in said)


@pytest.mark.long
def test_a_later_process_reads_what_an_earlier_one_compiled(module):
    words = [sys.executable, "-c", "import kernels; print(*kernels.FOUND)"]
    paths = {"PYTHONPATH": f"{module}{os.pathsep}{SOURCE}", "PYTHONDONTWRITEBYTECODE": "1"}
    said = [subprocess.check_output(words, env=os.environ | paths, text=True) for _ in range(2)]
    assert said == ["8 0\n", "8 1\n"]


def test_a_kernel_is_compiled_anew_where_one_of_another_package_of_texvent_changed(module):
    """As a plug-in's, which calls those of texvent_scenes."""
    head = "from texvent_more.inner import twice\n"
    (module / "kernels.py").write_text(head + KERNELS.replace("2 * x", "twice(x)"))
    (module / "texvent_more").mkdir()
    inner = "from texvent.runtime.jit import jit\n\n@jit\ndef twice(x):\n    return {} * x\n"
    words = [sys.executable, "-c", "import kernels; print(*kernels.FOUND)"]
    paths = {"PYTHONPATH": f"{module}{os.pathsep}{SOURCE}", "PYTHONDONTWRITEBYTECODE": "1"}
    said = []
    for factor in (2, 2, 3):
        (module / "texvent_more" / "inner.py").write_text(inner.format(factor))
        said.append(subprocess.check_output(words, env=os.environ | paths, text=True))
    assert said == ["8 0\n", "8 1\n", "12 0\n"]


def without_folders(module):
    """Put files where Numba would make its folders: not even root can."""
    (module / "__pycache__").write_text("")
    (module.parent / "no-home").write_text("")
    return {"HOME": str(module.parent / "no-home")}


def kept_in(folder):
    (file,) = folder.rglob("*.nbc")
    return file


def flip(file, share):
    content = bytearray(file.read_bytes())
    content[int(share * len(content))] ^= 0x10
    file.write_bytes(content)


DAMAGE = {
    "empty": lambda file: file.write_bytes(b""),
    "half": lambda file: file.write_bytes(file.read_bytes()[: file.stat().st_size // 2]),
    **{
        f"a flipped bit at {share}": partial(flip, share=share) for share in (0, 0.2, 0.4, 0.6, 0.8)
    },
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
