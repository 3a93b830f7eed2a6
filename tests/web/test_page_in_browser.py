"""The scripts of the pages, in a browser."""

from pathlib import Path

from selenium.webdriver.support.wait import WebDriverWait

from texvent.capture.open import open_frames
from texvent.cli.simulation.web import LEAD
from texvent.config import CaptureConfig
from texvent.web.job_page import JobServer
from texvent.web.live import LiveEvents
from texvent.web.live_page import LiveServer

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
WAIT_S = 300


def test_a_prompt_gives_a_preview_and_a_viewer_and_a_mistake_one_line(browser, requests_made):
    with JobServer() as page:
        browser.get(page.entry)
        status = browser.find_element("id", "status")
        for name, value in (("duration", "0.1"), ("seed", "3")):
            field = browser.find_element("id", name)
            field.clear()
            field.send_keys(value)
        browser.find_element("id", "make").click()
        wait = WebDriverWait(browser, WAIT_S)
        wait.until(lambda _: "events   " in status.get_attribute("textContent"))
        video = browser.find_element("id", "preview")
        wait.until(lambda _: browser.execute_script("return arguments[0].videoWidth", video) > 100)
        browser.switch_to.frame(browser.find_element("id", "viewer"))
        wait.until(lambda _: browser.find_elements("id", "shown-text"))
        browser.switch_to.default_content()
        assert not browser.find_element("id", "stop").is_enabled()
        assert [url for url in requests_made() if not url.startswith(page.address)] == []
        browser.find_element("css selector", "#prompt").clear()
        browser.find_element("id", "make").click()
        wait.until(lambda _: "failed" in status.get_attribute("class"))
        assert "PROMPT must not be empty" in status.text


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
    live = LiveEvents(open_frames(CLIP, CaptureConfig()), {"simulator": "esim"})
    with LiveServer(live, "clip.mp4", tmp_path) as page:
        browser.get(page.entry)
        browser.refresh()
        assert browser.current_url == page.address  # without the token
        at, wait = (lambda name: browser.find_element("id", name)), WebDriverWait(browser, WAIT_S)
        wait.until(lambda _: at("median").text.endswith(" ms"))
        assert at("events").get_attribute("naturalWidth") == "320"
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
