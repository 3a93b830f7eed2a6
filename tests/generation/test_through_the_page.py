"""A learned model from the form of `texvent app` to the files that the page hands out."""

import warnings
from pathlib import Path

import pytest
from selenium.webdriver.support.select import Select
from selenium.webdriver.support.wait import WebDriverWait

import texvent
from texvent.io.files import load
from texvent.web.job_page import JobServer

pytestmark = pytest.mark.torch
pytest.importorskip("torch")
pytest.importorskip("diffusers")

WAIT_S = 300
FILES = {"h5": "events.h5", "mp4": "events.events.mp4", "html": "events.events.html"}.items()


def test_a_folder_of_weights_runs_from_the_form_to_the_downloads(
    browser, models, model_cache, tmp_path
):
    path = models("wan")
    with JobServer(path.parent) as page:
        browser.get(page.entry)
        at, wait = (lambda name: browser.find_element("id", name)), WebDriverWait(browser, WAIT_S)
        Select(at("generator")).select_by_value("another model")
        prompt = f"a red cat walks, take {tmp_path.name}"  # downloads of no other test
        values = {"prompt": prompt, "other": path.name, "fps": 16, "length": 5, "seed": 4}
        for name, value in values.items():
            at(name).clear()
            at(name).send_keys(str(value))
        at("make").click()
        wait.until(lambda _: "running" not in at("status").get_attribute("class"))
        assert "events   " in at("status").get_attribute("textContent"), at("status").text
        wait.until(lambda _: browser.execute_script("return preview.videoWidth") > 100)
        files = {name: page.job.file(name).read_bytes() for _, name in FILES}
        for link in browser.find_elements("css selector", "#results a"):
            link.click()
        got = {
            Path(browser.downloads, f"{page.job.name}.{end}"): files[name] for end, name in FILES
        }
        wait.until(lambda _: all(map(Path.is_file, got)))  # Chromium renames them when complete
        assert all(path.read_bytes() == content for path, content in got.items())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", texvent.TexventWarning)  # noise looks like a failed video
        wanted = texvent.generate(prompt, generator=str(path), frames=5, fps=16, seed=4)
    assert load(next(iter(got))).equals(wanted)
