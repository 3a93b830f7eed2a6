"""The page opened in a real browser: it draws, it obeys, and it asks nothing of the network."""

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from texvent.events import EventStream
from texvent.frames import Video
from texvent.sensor import SensorSize
from texvent.view.page.writer import show
from texvent.view.render import render_events

SIZE = SensorSize(64, 48)
WAIT_S = 300


def cube_of_events(count: int = 20_000) -> EventStream:
    index = np.arange(count)
    t = index * 2_000_000 // count
    return EventStream(index * 7 % 64, index * 13 % 48, t, index % 2, SIZE, {"prompt": "p"})


def colourful_video() -> Video:
    """Frame i of 4 is one grey level, 500 ms long."""
    pixels = np.stack([np.full((48, 64, 3), 60 * i, dtype=np.uint8) for i in range(4)])
    return Video(pixels, [0, 500_000, 1_000_000, 1_500_000])


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("page") / "out.html"
    return render_events(cube_of_events(), target, frames=colourful_video())


def run(browser: Any, script: str) -> Any:
    """The value of a script two screen refreshes later, when everything was drawn."""
    return browser.execute_async_script(
        "const done = arguments[0]; (() => {" + script + "})();"
        "requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame("
        "() => done(true))));"
    )


def text(browser: Any, name: str) -> str:
    return str(browser.execute_script(f"return document.getElementById('{name}').textContent"))


def click(browser: Any, name: str) -> None:
    run(browser, f"document.getElementById('{name}').click()")


def slide(browser: Any, name: str, value: int, event: str = "input") -> None:
    run(
        browser,
        f"const one = document.getElementById('{name}'); one.value = {value};"
        f"one.dispatchEvent(new Event('{event}'));",
    )


def drag(browser: Any, name: str, start: tuple[float, float], stop: tuple[float, float]) -> None:
    """Press, move and let go; ends are shares of the element's width and height."""
    from selenium.webdriver import ActionChains

    box = browser.execute_script(
        f"const one = document.getElementById('{name}'); one.scrollIntoView({{block: 'center'}});"
        "const box = one.getBoundingClientRect(); return [box.x, box.y, box.width, box.height];"
    )
    places = [(box[0] + x * box[2], box[1] + y * box[3]) for x, y in (start, stop)]
    chain = ActionChains(browser, duration=0)
    pointer = chain.w3c_actions.pointer_action
    pointer.move_to_location(*map(round, places[0]))
    pointer.pointer_down()
    pointer.move_to_location(*map(round, places[1]))
    pointer.pointer_up()
    chain.perform()
    run(browser, "")


def window_on_the_curve(browser: Any) -> tuple[float, float]:
    """Ends of the window that the curve annotations, in thousandths of its width."""
    start, width = (
        float(browser.find_element("id", "rate-window").get_attribute(name))
        for name in ("x", "width")
    )
    return start, start + width


def open_whole(browser: Any, page: Path) -> None:
    """Open a page, stop it and show the whole recording."""
    browser.get(page.as_uri())
    slide(browser, "start", 0)
    slide(browser, "length", 1000)


@contextlib.contextmanager
def emulated(browser: Any, *, size: tuple[int, int], **features: str) -> Iterator[None]:
    """A screen of that size, CSS pixels, whose visitor prefers what `features` say."""
    screen = {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": False}
    media = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": media})
    try:
        yield
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def image_of(browser: Any, name: str) -> np.ndarray:
    png = browser.find_element("id", name).screenshot_as_png
    image = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    assert image is not None
    return image


def coloured_pixels(image: np.ndarray) -> tuple[int, int]:
    """How many pixels are blue and how many are red."""
    signed = image[..., 0].astype(int) - image[..., 2]
    return int((signed > 60).sum()), int((signed < -60).sum())


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_it_opens_playing_with_every_control_on_the_first_screen(browser, page, size):
    with emulated(browser, size=size):
        browser.get(page.as_uri())
        run(browser, "")
        assert "Pause" in text(browser, "play")
        assert text(browser, "length-text") == "40.00 ms"
        bottoms = browser.execute_script(
            "return [...document.querySelectorAll('#controls button, #controls input')]"
            ".map((one) => one.getBoundingClientRect().bottom)"
        )
        assert len(bottoms) == 14
        assert max(bottoms) < size[1]
        assert browser.execute_script(
            "return document.documentElement.scrollWidth <= window.innerWidth"
        )


def test_it_opens_on_the_busiest_window_and_rests_where_motion_is_unwanted(browser, tmp_path):
    # 1 s with an event per ms, and 900 more between 0.6 and 0.63 s.
    times = np.sort(np.r_[np.arange(0, 1_000_000, 1000), np.linspace(600_000, 629_999, 900)])
    zeros = np.zeros(len(times), np.int64)
    events = EventStream(zeros, zeros, times.astype(np.int64), zeros, SIZE)
    page = show(events, tmp_path / "burst.html")
    with emulated(browser, size=(1280, 800), prefers_reduced_motion="reduce"):
        browser.get(page.as_uri())
        run(browser, "")
        assert "Play" in text(browser, "play")
        assert 0.59 <= float(text(browser, "start-text").split()[0]) <= 0.6
        shown = int(text(browser, "shown-text").split()[0])
        assert 938 <= shown <= 941


@pytest.mark.parametrize(("scheme", "is_dark"), [("dark", True), ("light", False)])
def test_the_cloud_is_as_dark_as_the_visitor_wants(browser, page, scheme, is_dark):
    with emulated(browser, size=(1280, 800), prefers_color_scheme=scheme):
        open_whole(browser, page)
        for name in ("cloud-canvas", "rate-curve"):
            corner = image_of(browser, name)[2, 2]
            assert bool(corner.max() < 60) == is_dark, name
        blue, red = coloured_pixels(image_of(browser, "cloud-canvas"))
        assert min(blue, red) > 3_000
        assert 0.5 < blue / red < 2.0


def test_the_page_asks_nothing_of_any_server_and_makes_no_complaint(browser, page, requests_made):
    browser.get(page.as_uri())
    click(browser, "play")
    assert requests_made() == [page.as_uri()]
    assert browser.get_log("browser") == []


def test_polarity_buttons_hide_one_colour(browser, page):
    open_whole(browser, page)
    click(browser, "toggle-off")
    blue, red = coloured_pixels(image_of(browser, "cloud-canvas"))
    assert blue > 3_000
    assert red == 0
    assert text(browser, "shown-text").startswith("10,000 of the cloud's 20,000 events")
    pressed = browser.find_element("id", "toggle-off").get_attribute("aria-pressed")
    assert pressed == "false"


def test_sliders_choose_the_time_and_the_video_follows(browser, page):
    browser.get(page.as_uri())
    slide(browser, "length", 100)
    slide(browser, "start", 505)
    assert text(browser, "length-text") == "199.99 ms"
    assert text(browser, "start-text") == "1.010 s"
    assert text(browser, "shown-text").startswith("2,000 of the cloud's 20,000")
    grey = image_of(browser, "video-canvas")[5:-5, 5:-5].mean()
    assert abs(grey - 120) < 4, "the frame that begins at 1.0 s"


def test_playing_moves_the_window_and_space_stops_it(browser, page):
    from selenium.webdriver.support.wait import WebDriverWait

    open_whole(browser, page)
    click(browser, "play")
    moved = "return Number(document.getElementById('start').value) > 5"
    WebDriverWait(browser, WAIT_S).until(lambda one: one.execute_script(moved))
    browser.find_element("id", "cloud-canvas").send_keys(" ")
    assert browser.find_element("id", "play").get_attribute("aria-pressed") == "false"
    run(browser, "")
    stopped = text(browser, "start-text")
    run(browser, "")
    assert text(browser, "start-text") == stopped


def test_a_region_is_selected_by_dragging_and_by_typing(browser, page):
    open_whole(browser, page)
    before = sum(coloured_pixels(image_of(browser, "cloud-canvas")))
    drag(browser, "plane-canvas", (0.25, 0.25), (0.75, 0.75))
    values = [
        int(browser.find_element("id", f"region-{name}").get_attribute("value"))
        for name in ("x0", "x1", "y0", "y1")
    ]
    np.testing.assert_allclose(values, [16, 47, 12, 35], atol=1)
    shown = int(text(browser, "shown-text").split()[0].replace(",", ""))
    assert abs(shown - 5_000) < 500, "a quarter of the plane holds a quarter of the events"
    assert sum(coloured_pixels(image_of(browser, "cloud-canvas"))) < 0.6 * before
    assert browser.find_element("id", "rate-region").get_attribute("d").count("V") > 10
    slide(browser, "region-x0", 0, "change")
    slide(browser, "region-x1", 0, "change")
    slide(browser, "region-y0", 0, "change")
    slide(browser, "region-y1", 0, "change")
    events = cube_of_events()
    alone = int(((events.x == 0) & (events.y == 0)).sum())
    assert text(browser, "shown-text").startswith(f"{alone:,} of")
    click(browser, "region-clear")
    assert text(browser, "shown-text").startswith("20,000 of")


def test_dragging_on_the_curve_chooses_the_time(browser, page):
    browser.get(page.as_uri())
    drag(browser, "rate-curve", (0.5, 0.5), (0.25, 0.5))
    np.testing.assert_allclose(window_on_the_curve(browser), [250, 500], atol=4)
    length = text(browser, "length-text")
    drag(browser, "rate-curve", (0.7, 0.5), (0.7, 0.5))
    assert text(browser, "length-text") == length, "a click keeps the length"
    assert abs(sum(window_on_the_curve(browser)) / 2 - 700) < 4


def test_keys_turn_the_cloud(browser, page):
    from selenium.webdriver.common.keys import Keys

    open_whole(browser, page)
    before = image_of(browser, "cloud-canvas")
    canvas = browser.find_element("id", "cloud-canvas")
    canvas.send_keys(Keys.ARROW_LEFT * 4, "+")
    run(browser, "")
    assert (image_of(browser, "cloud-canvas") != before).any(axis=2).mean() > 0.02
    canvas.send_keys("0")
    slide(browser, "start", 0)
    slide(browser, "length", 250)
    canvas.send_keys("..")
    run(browser, "")
    assert text(browser, "start-text") == "1.000 s"


def test_a_browser_without_webgl_says_what_is_missing_and_shows_the_rest(browser, page):
    source = """const real = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === "webgl" ? null : real.call(this, kind, ...rest);
      };"""
    added = browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": source})
    browser.get(page.as_uri())
    browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)
    run(browser, "")
    fallback = browser.find_element("id", "cloud-fallback")
    assert fallback.is_displayed()
    assert fallback.text.startswith("This browser offers no WebGL")
    slide(browser, "length", 100)
    assert text(browser, "shown-text").startswith("2,000 of")
    assert min(coloured_pixels(image_of(browser, "plane-canvas"))) > 50


def test_a_recording_without_events_says_so(browser, tmp_path):
    browser.get(show(EventStream.empty(SIZE), tmp_path / "empty.html").as_uri())
    assert browser.find_element("id", "cloud-fallback").text == "This recording holds no events."
    assert not browser.find_element("id", "controls").is_displayed()
    assert browser.get_log("browser") == []
