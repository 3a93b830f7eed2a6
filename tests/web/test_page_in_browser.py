"""The script of the page, in a browser."""

from selenium.webdriver.support.wait import WebDriverWait

from texvent.web.job_page import JobServer

WAIT_S = 300


def test_a_prompt_gives_a_preview_and_a_viewer_and_a_mistake_one_line(browser, requests_made):
    with JobServer() as page:
        browser.get(page.address)
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
