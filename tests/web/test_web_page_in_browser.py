"""The web page, served as `texvent app` serves it and used as a visitor would."""

from __future__ import annotations

import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.web.served import served

import texvent

pytest.importorskip("gradio", reason="gradio is an extra; make test-app")

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
WAIT_S = 120

pytestmark = pytest.mark.app


@pytest.fixture(scope="module")
def temporary(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("temporary")


@pytest.fixture(scope="module")
def address(temporary: Path) -> Iterator[str]:
    with served(temporary) as line:
        yield line


@pytest.fixture
def page(browser: Any, address: str) -> Any:
    """The page as a new visitor finds it."""
    browser.execute_cdp_cmd("Network.clearBrowserCookies", {})
    browser.get(address)
    until(browser, lambda: browser.find_elements("id", "examples"))
    return browser


def until(browser: Any, condition: Any) -> Any:
    from selenium.common.exceptions import (
        ElementClickInterceptedException,
        ElementNotInteractableException,
        StaleElementReferenceException,
    )
    from selenium.webdriver.support.wait import WebDriverWait

    moving = [
        ElementClickInterceptedException,
        ElementNotInteractableException,
        StaleElementReferenceException,
    ]
    patient = WebDriverWait(browser, WAIT_S, ignored_exceptions=moving)
    return patient.until(lambda _: condition())


def status(page: Any) -> str:
    return str(page.find_element("id", "status").text)


def make_events(page: Any, prompt: str) -> str:
    """Type a prompt, press the button, wait; returns what the page says."""
    from selenium.webdriver.common.keys import Keys

    field = page.find_element("css selector", "#prompt textarea")
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys(prompt)
    page.find_element("id", "from-prompt").click()
    until(page, lambda: "events on" in status(page) or "did not work" in status(page))
    return status(page)


def enter(page: Any, which: str, text: str) -> None:
    """Replace what a number's field holds."""
    from selenium.webdriver.common.keys import Keys

    field = page.find_element("css selector", f"#{which} input")
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys(Keys.DELETE, text)


def upload(page: Any, path: Path) -> None:
    page.find_element("xpath", "//button[@role='tab'][contains(., 'Video')]").click()
    until(page, lambda: page.find_element("id", "from-video").is_displayed())
    page.find_element("css selector", "#video input[type=file]").send_keys(str(path))


def choose(page: Any, which: str, name: str) -> bool:
    """Try to choose a name; True once it is chosen. A list that still moves loses a click."""
    field = page.find_element("css selector", f"#{which} input")
    if name in field.get_attribute("value"):
        return True
    field.click()
    for choice in page.find_elements("xpath", f"//ul[@role='listbox']//li[contains(., '{name}')]"):
        choice.click()
    return False


def test_a_prompt_gives_a_video_a_viewer_and_a_download(
    page: Any, address: str, tmp_path: Path, requests_made: Any
) -> None:
    said = make_events(page, "a red ball bounces on the grass")
    assert "ball" in said
    count = int(said.split()[0].replace(",", ""))

    video = until(page, lambda: page.find_elements("css selector", "video#preview"))[0]
    until(page, lambda: page.execute_script("return arguments[0].videoWidth", video) > 600)
    page.switch_to.frame(until(page, lambda: page.find_elements("id", "texvent-viewer"))[0])
    until(page, lambda: f"of the cloud's {count:,}" in page.find_element("id", "shown-text").text)
    page.switch_to.default_content()

    until(page, lambda: choose(page, "format", "evt3"))
    folder = {"behavior": "allow", "downloadPath": str(tmp_path)}
    page.execute_cdp_cmd("Browser.setDownloadBehavior", folder)
    page.find_element("id", "download").click()
    target = tmp_path / "events.raw"
    until(page, target.exists)
    assert len(texvent.load(target, format="evt3")) == count
    link = page.find_element("id", "download-link").get_attribute("href")
    with pytest.raises(urllib.error.HTTPError, match="404") as refused:
        urllib.request.urlopen(link)  # no other session has this result
    refused.value.close()

    asked = requests_made()
    assert len(asked) > 10
    assert [url for url in asked if not url.startswith(address)] == []


def test_the_main_options_are_on_the_first_screen_and_stop_rests(page: Any) -> None:
    names = ("from-prompt", "simulator", "preset", "sensor", "seed", "status", "stop")
    bottoms = page.execute_script(
        "return arguments[0].map((id) => document.getElementById(id))"
        ".map((one) => one.getBoundingClientRect().bottom)",
        names,
    )
    assert max(bottoms) < 700, dict(zip(names, bottoms, strict=True))
    examples = page.find_element("id", "examples")
    assert examples.rect["x"] > 380  # beside the options, at first in place of the results
    assert examples.rect["y"] < 250
    assert not page.find_element("id", "stop").is_enabled()
    assert not page.find_elements("id", "download")


@pytest.mark.parametrize("width", [390, 1280])
def test_no_name_of_a_select_runs_into_its_arrow(page: Any, width: int) -> None:
    page.set_window_size(width, 1100)
    room = page.execute_script(
        """return [...document.querySelectorAll("input[role=combobox]")].map((field) => {
          const arrow = field.parentElement.querySelector(".icon-wrap").getBoundingClientRect();
          const inside = field.getBoundingClientRect().right
            - parseFloat(getComputedStyle(field).paddingRight);
          return arrow.left - inside;
        })"""
    )
    assert len(room) == 4, page.execute_script("return innerWidth")
    assert min(room) >= 0


def test_stop_ends_a_job_and_rests_again(page: Any) -> None:
    page.find_element("id", "from-prompt").click()
    until(page, page.find_element("id", "stop").is_enabled)
    until(page, lambda: "starting" in status(page) or "frame" in status(page))
    page.find_element("id", "stop").click()
    until(page, lambda: "Stopped" in status(page))
    assert not page.find_element("id", "stop").is_enabled()


def test_a_reload_finds_the_job_and_then_its_result_and_another_tab_does_not(
    page: Any, address: str
) -> None:
    enter(page, "duration", "0.2")
    page.find_element("id", "from-prompt").click()
    until(page, page.find_element("id", "stop").is_enabled)
    page.refresh()
    until(page, lambda: "events on" in page.find_element("id", "status").text)
    until(page, lambda: page.find_elements("id", "texvent-viewer"))
    page.refresh()
    until(page, lambda: page.find_elements("id", "download"))
    assert "events on" in status(page)
    first = page.current_window_handle
    page.switch_to.new_window("tab")
    page.get(address)
    until(page, lambda: "No events yet" in page.find_element("id", "status").text)
    page.close()
    page.switch_to.window(first)


def test_an_error_names_its_field_and_takes_the_place_of_the_one_before(page: Any) -> None:
    for field, value, message in (
        ("duration", "1000", "duration is 1000 s; at most 0.2 s here"),
        ("duration", "", "duration is empty"),
        ("seed", "-3", "seed is -3"),
    ):
        enter(page, field, value)
        page.find_element("id", "from-prompt").click()
        until(page, lambda said=message: said in status(page))
        assert status(page).startswith("This did not work.")
        assert not page.find_element("id", "stop").is_enabled()
        enter(page, "duration", "0.2")
    assert not page.find_elements("class name", "toast-body")


def test_an_example_fills_in_its_prompt(page: Any) -> None:
    images = until(page, lambda: page.find_elements("css selector", "#examples .thumbnail-lg"))
    assert len(images) >= 6
    page.execute_script("arguments[0].click()", images[2])
    field = page.find_element("css selector", "#prompt textarea")
    until(page, lambda: "sharks" in field.get_attribute("value"))


def test_bad_uploads_are_refused_and_harm_nobody(page: Any, tmp_path: Path) -> None:
    broken = tmp_path / "broken.mp4"
    broken.write_bytes(b"this is no video" * 99)
    for path, message in ((broken, "broken.mp4"), (CLIP, "at most 0.2 s are taken here")):
        upload(page, path)
        until(page, lambda name=path.name: name[:6] in page.find_element("id", "video").text)
        page.find_element("id", "from-video").click()
        until(page, lambda: "did not work" in status(page))
        assert message in status(page)
        assert "/" not in status(page)
        page.refresh()
        until(page, lambda: page.find_elements("id", "from-prompt"))
    assert "events on" in make_events(page, "a ball bounces")


def test_a_file_that_is_too_large_is_not_taken(page: Any, temporary: Path, tmp_path: Path) -> None:
    large = tmp_path / "large.mp4"
    large.write_bytes(bytes(2 * 2**20))
    upload(page, large)
    until(page, lambda: "exceed" in page.find_element("tag name", "body").text.lower())
    assert not [path for path in temporary.rglob("*large*") if path.is_file()]


def test_an_empty_prompt_is_one_clear_error(page: Any) -> None:
    assert "the prompt is empty" in make_events(page, "   ")


def test_hostile_text_stays_text(page: Any, tmp_path: Path) -> None:
    mischief = "<img src=x onerror=document.title='broken-into'>"
    make_events(page, f'a ball {mischief} "></iframe><script>document.title=1</script> \u2028')
    page.switch_to.frame(until(page, lambda: page.find_elements("id", "texvent-viewer"))[0])
    until(page, lambda: "\u2028" in page.page_source)
    assert page.execute_script("return document.title").startswith("a ball <img")
    assert not page.find_elements("css selector", "img[onerror]")
    page.switch_to.default_content()
    clip = tmp_path / "<img src=x onerror=alert(1)>.mp4"
    clip.write_bytes(b"no video")
    upload(page, clip)
    until(page, lambda: "onerror" in page.find_element("id", "video").text)
    page.find_element("id", "from-video").click()
    until(page, lambda: "did not work" in status(page))
    assert page.title == "texvent"
    assert not page.find_elements("css selector", "img[onerror]")
