"""The scripts of the pages, in a browser."""

from pathlib import Path

import pytest
from selenium.webdriver.support.select import Select
from selenium.webdriver.support.wait import WebDriverWait

from texvent.capture.open import open_frames
from texvent.cli.simulation.pages import LEAD
from texvent.config import CaptureConfig
from texvent.web.job_page import JobServer, list_examples, list_generators
from texvent.web.live import LiveEvents
from texvent.web.live_page import LiveServer

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
WAIT_S = 300


def test_a_prompt_gives_a_preview_and_a_viewer_and_a_mistake_one_line(browser, requests_made):
    with JobServer() as page:
        browser.get(page.entry)
        status = browser.find_element("id", "status")
        for name, value in (("length", "0.1"), ("seed", "3"), ("prompt", "a red ball bounces")):
            field = browser.find_element("id", name)
            field.clear()
            field.send_keys(value)
        browser.find_element("id", "make").click()
        wait = WebDriverWait(browser, WAIT_S)
        wait.until(lambda _: browser.execute_script("return stills.naturalWidth") > 100)
        wait.until(lambda _: "events   " in status.get_attribute("textContent"))
        video = browser.find_element("id", "preview")
        wait.until(lambda _: browser.execute_script("return arguments[0].videoWidth", video) > 100)
        browser.switch_to.frame(browser.find_element("id", "viewer"))
        wait.until(lambda _: browser.find_elements("id", "shown-text"))
        browser.switch_to.default_content()
        wait.until(lambda _: browser.execute_script("return viewer.clientHeight") > 1000)  # whole
        links = browser.find_elements("css selector", "#results a")
        names = [link.get_attribute("download") for link in links]
        assert names == [f"a-red-ball-bounces.{ending}" for ending in ("h5", "mp4", "html")]
        assert not browser.find_element("id", "stop").is_enabled()
        assert [url for url in requests_made() if not url.startswith(page.address)] == []
        browser.find_element("css selector", "#prompt").clear()
        browser.find_element("id", "make").click()
        wait.until(lambda _: "failed" in status.get_attribute("class"))
        assert "PROMPT must not be empty" in status.text


@pytest.mark.parametrize("width", [390, 1280])
def test_the_form_offers_examples_words_and_files_and_a_reload_keeps_what_was_typed(
    browser, tmp_path, width
):
    with JobServer(CLIP.parent) as page:
        metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        browser.get(page.entry)
        at, wait = (lambda name: browser.find_element("id", name)), WebDriverWait(browser, WAIT_S)
        value = lambda name: at(name).get_attribute("value")  # noqa: E731
        for card, one in zip(
            browser.find_elements("css selector", "#examples button"), list_examples(), strict=True
        ):
            card.click()
            assert value("prompt") == one["text"].strip()
        browser.find_element("css selector", "#known summary").click()
        wait.until(lambda _: browser.find_elements("css selector", "#words .chip"))
        at("prompt").clear()
        at("prompt").send_keys("a red")
        at("sought").send_keys("squirrel")
        shown = (
            "return [...document.querySelectorAll('#words .chip')].filter(one => one.offsetParent)"
        )
        (squirrel,) = browser.execute_script(shown)
        squirrel.click()
        (tmp_path / "a clip.mp4").write_bytes(CLIP.read_bytes())
        at("file").send_keys(str(tmp_path / "a clip.mp4"))
        wait.until(lambda _: value("video") == f"{page.folder}/sent/a-clip.mp4")
        for generator in ("wan-1.3b", "procedural", "wan-1.3b"):
            Select(at("generator")).select_by_value(generator)
            length = list_generators()[generator]["default"]
            assert float(value("length")) == length
        browser.refresh()
        assert value("prompt") == "a red squirrel"
        assert value("video").endswith("/a-clip.mp4")
        assert (value("generator"), value("length")) == ("wan-1.3b", "81")
        assert browser.execute_script("return document.documentElement.scrollWidth") == width
        at("clear").click()
        assert value("video") == ""
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_a_link_of_another_page_or_file_opens_the_page_and_an_old_cookie_says_what_to_do(
    browser, tmp_path
):
    with JobServer() as page, JobServer() as other:
        lead = tmp_path / "open.html"
        lead.write_text(LEAD.format(page.entry))
        browser.get(lead.as_uri())
        wait = WebDriverWait(browser, WAIT_S)
        wait.until(lambda _: browser.current_url == page.address)
        wait.until(lambda _: browser.find_elements("id", "make"))
        browser.get(other.address)
        assert "open the address that texvent printed" in browser.page_source
        browser.get(other.entry)
        browser.get(page.address)  # each server has a cookie of its own
        assert browser.find_elements("id", "make")
        page.token = "that of a later server"
        browser.find_element("id", "make").click()
        status = browser.find_element("id", "status")
        wait.until(lambda _: "open the address that texvent printed" in status.text)


def test_the_live_page_shows_latency_records_and_says_that_it_closes(browser, tmp_path):
    options = {"simulator": "esim", "interpolate": "none", "sensor": "80x45"}
    live = LiveEvents(open_frames(CLIP, CaptureConfig()), options)
    with LiveServer(live, "clip.mp4", tmp_path) as page:
        browser.get(page.entry)
        browser.refresh()
        assert browser.current_url == page.address  # without the token
        at, wait = (lambda name: browser.find_element("id", name)), WebDriverWait(browser, WAIT_S)
        wait.until(lambda _: at("median").text.endswith(" ms"))
        assert at("events").get_attribute("naturalWidth") == "80"
        at("file").clear()
        at("file").send_keys("no/a.h5")
        at("record").click()
        wait.until(lambda _: "does not exist" in at("error").text)
        at("file").clear()
        at("file").send_keys("a.h5")
        at("format").send_keys("npz")
        at("record").click()
        wait.until(lambda _: at("record").text == "Stop")
        assert not at("simulator").is_enabled()
        at("record").click()
        wait.until(lambda _: at("status").text == f"Recorded {tmp_path}/a.npz.")
        assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]
        assert not page.is_over()
        browser.get("about:blank")
        wait.until(lambda _: page.is_over())
