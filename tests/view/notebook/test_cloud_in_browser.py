"""A display in a real browser: the cloud turns, the theme is the notebook's, no network."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(64, 48)
DARK = 'data-jp-theme-light="false"'
LIGHT = 'data-jp-theme-light="true"'


def cube(count: int = 20_000) -> EventStream:
    index = np.arange(count)
    return EventStream(
        index * 7 % 64, index * 13 % 48, index * 100, index % 2, SIZE, {"prompt": "p"}
    )


def open_notebook(
    browser: Any, folder: Path, theme: str, *, script: bool = True, policy: str = "img-src data:"
) -> None:
    """A page as notebooks are, with two displays in it."""
    output = cube()._repr_mimebundle_()["text/html"]
    page = folder / "notebook.html"
    page.write_text(
        "<!doctype html><meta charset=utf-8>"
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        f"<body {theme}><p id=other>{'text ' * 9}</p>"
        f"{output}{output}</body>",
        encoding="utf-8",
    )
    browser.get(page.as_uri())
    if script:
        into_frame(browser, 0)
        drawn(browser)


def into_frame(browser: Any, number: int) -> None:
    browser.switch_to.default_content()
    browser.switch_to.frame(number)


def drawn(browser: Any, script: str = "") -> Any:
    """The value of a script, three screen refreshes later."""
    return browser.execute_async_script(
        "const done = arguments[0]; const value = (() => {" + script + "})();"
        "const wait = (n) => n ? requestAnimationFrame(() => wait(n - 1)) : done(value); wait(3);"
    )


def canvas(browser: Any) -> np.ndarray:
    png = browser.find_element("id", "cloud-canvas").screenshot_as_png
    return cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)


def colours(image: np.ndarray) -> tuple[int, int]:
    """How many pixels are blue and how many are red."""
    signed = image[..., 0].astype(int) - image[..., 2]
    return int((signed > 60).sum()), int((signed < -60).sum())


def test_the_cloud_is_drawn_in_both_colours_and_turns(browser, tmp_path):
    open_notebook(browser, tmp_path, LIGHT)
    before = canvas(browser)
    assert min(colours(before)) > 1000
    key = "new KeyboardEvent('keydown', {key: 'ArrowRight'})"
    turn = f"for (let i = 0; i < 8; i++) element.dispatchEvent({key});"
    turn = f"const element = document.getElementById('cloud-canvas'); {turn}"
    drawn(browser, turn)
    after = canvas(browser)
    assert min(colours(after)) > 1000
    assert (np.abs(before.astype(int) - after).max(axis=2) > 60).mean() > 0.02


def test_a_polarity_is_hidden_by_its_button_and_two_displays_do_not_meet(browser, tmp_path):
    open_notebook(browser, tmp_path, LIGHT)
    drawn(browser, "document.getElementById('toggle-off').click()")
    blue, red = colours(canvas(browser))
    assert red == 0
    assert blue > 1000
    into_frame(browser, 1)
    drawn(browser)
    assert min(colours(canvas(browser))) > 1000


@pytest.mark.parametrize("theme", [DARK, 'class="vscode-dark"'])
def test_the_theme_is_that_of_the_notebook(browser, tmp_path, theme):
    open_notebook(browser, tmp_path, theme)
    assert int(canvas(browser)[2, 2].max()) < 60
    browser.switch_to.default_content()
    shown = browser.execute_script(
        "return ['light', 'dark'].map((name) => document.querySelector("
        "`.texvent-view img.${name}`).offsetWidth > 0)"
    )
    assert shown == [False, True]


def test_a_change_of_theme_reaches_the_cloud(browser, tmp_path):
    open_notebook(browser, tmp_path, LIGHT)
    assert int(canvas(browser)[2, 2].min()) == 255
    browser.switch_to.default_content()
    browser.execute_script("document.body.dataset.jpThemeLight = 'false'")
    into_frame(browser, 0)
    drawn(browser)
    assert int(canvas(browser)[2, 2].max()) < 60


@pytest.mark.parametrize("width", [1200, 360])
def test_nothing_overflows_and_nothing_else_changes(browser, tmp_path, width):
    screen = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    try:
        open_notebook(browser, tmp_path, LIGHT)
        fits = "return document.documentElement.scrollWidth <= window.innerWidth"
        assert browser.execute_script(fits)
        browser.switch_to.default_content()
        assert browser.execute_script(fits)
        colour = "return getComputedStyle(document.getElementById('other')).color"
        assert browser.execute_script(colour) == "rgb(0, 0, 0)"
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_it_asks_nothing_of_the_network_and_no_script_fails(browser, tmp_path, requests_made):
    open_notebook(browser, tmp_path, LIGHT)
    assert all(url.startswith(("file:", "about:")) for url in requests_made())
    assert not [row for row in browser.get_log("browser") if row["level"] == "SEVERE"]


def test_it_works_where_a_policy_allows_no_frame_of_another_address(browser, tmp_path):
    allowed = "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"
    policy = f"default-src 'none'; frame-src 'none'; {allowed}"
    open_notebook(browser, tmp_path, LIGHT, policy=policy)
    assert min(colours(canvas(browser))) > 1000


def test_without_scripts_the_still_stays(browser, tmp_path):
    browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        open_notebook(browser, tmp_path, LIGHT, script=False)
        image = browser.find_element("css selector", ".texvent-view img.light")
        assert image.size["width"] > 200
    finally:
        browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})
