"""A browser, a moving texture; Triton's interpreter where there is no GPU; untimed properties."""

import contextlib
import functools
import gc
import json
import os
import shutil
import signal
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np
import pytest
from hypothesis import HealthCheck, settings
from tests import silence

if shutil.which("nvidia-smi") is None:
    # Triton looks when it is first imported, and other packages may import it first.
    os.environ.setdefault("TRITON_INTERPRET", "1")

# Events are those of the CPU on a machine with a GPU too; tests of GPUs name theirs.
os.environ.setdefault("TEXVENT_DEVICE", "cpu")

# A background job of a shell ignores SIGINT, one of nohup SIGHUP, and what tests start inherits it;
# of a handler it does not.
for number, handler in {
    signal.SIGINT: signal.default_int_handler,
    signal.SIGHUP: lambda *_: None,
}.items():
    if signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, handler)

# The stand-in for NVIDIA's guardrail must be importable before any test imports diffusers, which
# looks for it once.
sys.path.insert(0, str(Path(__file__).parent / "generation" / "stand_ins"))

# The first example may compile a kernel, and machines are busy: no property is held to a time.
UNTIMED = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("quick", UNTIMED, max_examples=50)
settings.register_profile("brief", UNTIMED, max_examples=12)
settings.register_profile("few", UNTIMED, max_examples=5)  # of kernels that are not compiled
settings.register_profile("thorough", UNTIMED, max_examples=1000)
settings.load_profile("quick")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
DRIVER = shutil.which("chromedriver")
OPTIONS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    # WebGL on the processor, so that no graphics card is needed.
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


FIRST = (
    # The pixel models and optical flow.
    ("tests/contract/test_golden.py::test_golden_events_are_those_of_the_release[frames=",),
    # The ray caster, and what follows motion.
    (
        "tests/scenes/raycast/",
        "tests/interpolate/motion/",
        "tests/contract/test_golden.py::test_golden_events_are_those_of_the_release[prompt=",
    ),
)
"""What each of two workers runs first: between them these compile most kernels."""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--brief",
        action="store_true",
        help="of a test over several tables, so many combinations that each row has its turn; of "
        "scenes a quarter of these, of a test marked long an eighth of the rows",
    )


_LONG_TABLE = 12
"""Rows from which on a brief run tries every second one."""
_STAGED = tuple(f"tests/scenes/{one}" for one in ("staging/", "checks/", "read/", "test_"))
"""Tests that stage a scene for each row."""


def choose_rows(items: list[pytest.Item]) -> set[str]:
    """Names of the tests of a brief run; names alone decide which rows these have."""
    groups = defaultdict(list)
    for item in sorted(items, key=lambda item: crc32(item.nodeid.encode())):
        groups[item.nodeid.partition("[")[0]].append(item)
    chosen = set()
    for group in groups.values():
        if group[0].get_closest_marker("long"):
            eighth = max(len(group) // 8, len(group) > 1)
            chosen |= {item.nodeid for item in group[:eighth]}
            continue
        calls = [(item.nodeid, getattr(item, "callspec", None)) for item in group]
        rows = {name: {*enumerate(call._idlist)} if call else {(0, "")} for name, call in calls}
        own: list[str] = []
        seen: set[tuple[int, str]] = set()
        for fresh in range(max(map(len, rows.values())), 0, -1):
            for name, row in rows.items():
                if len(row - seen) >= fresh:
                    seen |= row
                    own.append(name)
        # Sentences and nouns are many of a kind, and each is staged; so are rows of long tables.
        share = 4 if own[0].startswith(_STAGED) else 2 if len(own) >= _LONG_TABLE else 1
        chosen |= {*own[: -(-len(own) // share)]}
    return chosen


def pytest_configure(config: pytest.Config) -> None:
    silence.watch(config)


def pytest_collectstart() -> None:
    """Leave cycles of what is collected, nearly all of which stays, for the end of collection."""
    gc.disable()


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Let every second worker collect from the last file on: it finds compiled what the first did.

    In a fresh checkout each module is compiled once, which takes longer than all else here.
    """
    report = yield
    worker = getattr(collector.config, "workerinput", {}).get("workerid", "")
    if worker[-1:] in {*"13579"} and not isinstance(collector, pytest.File):
        report.result.reverse()
    return report


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what a brief run leaves out, and share out what compiles.

    In a fresh checkout every kernel is compiled once, and later read from disk by both workers of
    pytest-xdist. In the order of folders both would compile the same ones at the same time, so
    they begin with kernels that the other one does not need yet.
    """
    if config.getoption("brief"):
        chosen = choose_rows(items)
        config.hook.pytest_deselected(items=[one for one in items if one.nodeid not in chosen])
        items[:] = [item for item in items if item.nodeid in chosen]
    if not hasattr(config, "workerinput"):
        return
    items.sort(key=lambda item: item.path)  # the same for all workers
    groups = [[item for item in items if item.nodeid.startswith(first)] for first in FIRST]
    firsts = {item.nodeid for group in groups for item in group}
    rest = [item for item in items if item.nodeid not in firsts]
    # pytest-xdist gives each worker one half of the list, and lets it work from its beginning.
    split = max(0, len(items) // 2 - len(groups[0]))
    items[:] = groups[0] + rest[:split] + groups[1] + rest[split:]


def pytest_collection_finish(session: pytest.Session) -> None:
    """Spare the collector of cycles what stays to the end: it took a tenth of the suite's time."""
    gc.enable()
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


@pytest.fixture
def spawn() -> Iterator[Callable[..., subprocess.Popen[Any]]]:
    """`subprocess.Popen`, for processes that end with the test at the latest."""
    with contextlib.ExitStack() as ended:

        def begin(words: list[str], **options: Any) -> subprocess.Popen[Any]:
            process = ended.enter_context(subprocess.Popen(words, **options))
            ended.callback(process.kill)
            return process

        yield begin


@pytest.fixture(scope="session")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """Chromium without a window, started once."""
    if CHROMIUM is None or DRIVER is None:
        pytest.skip("chromium and chromedriver are not installed, so no page was opened")
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for option in (*OPTIONS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(option)
    folder = str(tmp_path_factory.mktemp("downloads"))
    options.add_experimental_option("prefs", {"download.default_directory": folder})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    driver.downloads = folder
    try:
        yield driver
    finally:
        driver.quit()


@pytest.fixture
def browser(chromium: Any) -> Iterator[Any]:
    """The browser on an empty page of 1280 × 1100 pixels, its logs emptied."""
    chromium.get("about:blank")
    chromium.set_window_size(1280, 1100)
    for log in ("browser", "performance"):
        chromium.get_log(log)
    yield chromium
    chromium.get("about:blank")


@pytest.fixture
def requests_made(browser: Any) -> Any:
    """Call it for the addresses asked for since it was called last, data: and blob: left out."""

    def addresses() -> list[str]:
        messages = [json.loads(row["message"])["message"] for row in browser.get_log("performance")]
        asked = [
            message["params"]["request"]["url"]
            for message in messages
            if message["method"] == "Network.requestWillBeSent"
        ]
        return [url for url in asked if not url.startswith(("data:", "blob:"))]

    return addresses


def _texture(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Waves of many directions and lengths (6 px and longer): smooth, never the same twice."""
    rng = np.random.default_rng(7)
    total = np.zeros_like(x)
    for _ in range(24):
        length, angle = rng.uniform(6, 40), rng.uniform(0, 2 * np.pi)
        phase = rng.uniform(0, 2 * np.pi)
        total += np.sin(2 * np.pi * (x * np.cos(angle) + y * np.sin(angle)) / length + phase)
    return 128.0 + 20.0 * total


@pytest.fixture(scope="session")
def moving_texture() -> Callable[..., np.ndarray]:
    """`moving_texture(dx, dy, width=, height=)`: float32 image of the texture moved by that.

    It is known at every position, so intermediate frames have an exact answer.
    """

    @functools.lru_cache(maxsize=256)  # many tests ask for the same few
    def drawn(dx: float, dy: float, width: int, height: int) -> np.ndarray:
        y, x = np.mgrid[:height, :width].astype(np.float64)
        return np.clip(_texture(x - dx, y - dy), 0, 255).astype(np.float32)

    def render(dx: float, dy: float = 0.0, *, width: int = 160, height: int = 120) -> np.ndarray:
        return drawn(dx, dy, width, height).copy()

    return render


@pytest.fixture
def install(tmp_path, monkeypatch) -> Iterator[Callable[..., None]]:
    """`install(package, entry_points, MODULE=source)`: another package, installed."""
    from texvent import _registry

    def add(package: str, entry_points: str, **modules: str) -> None:
        info = tmp_path / f"{package}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(entry_points)
        for name, source in modules.items():
            (tmp_path / f"{name}.py").write_text(source)
        _registry._plugged_in.cache_clear()

    monkeypatch.syspath_prepend(tmp_path)
    yield add
    _registry._plugged_in.cache_clear()


@pytest.fixture
def held_back(monkeypatch) -> str:
    """Name of a simulator whose events all come at the end; see held_back.py."""
    from texvent import _registry

    name = "held-back"
    found = {"texvent.simulators": {name: "tests.held_back:HeldBack"}}
    plugged_in = _registry._plugged_in

    def find(group: str, *, is_own: bool) -> Any:
        return plugged_in(group, is_own=True) if is_own else found.get(group, {})

    monkeypatch.setattr(_registry, "_plugged_in", find)
    return name
