# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery's page in Chromium: what a visitor sees, drags, chooses and reads."""

import re

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from scenes.gallery.page import number


class Compare:
    """A figure's two pictures, menus and slider."""

    def __init__(self, browser, figure: str):
        self.browser = browser
        self.box = browser.find_element(By.CSS_SELECTOR, f"[data-figure={figure}]")
        self.slider = self.box.find_element(By.CSS_SELECTOR, "input[type=range]")
        browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", self.box)

    def image(self, side: str):
        return self.box.find_element(By.CSS_SELECTOR, f"img.{side}")

    def file(self, side: str) -> str:
        return self.image(side).get_attribute("src").rpartition("/")[2]

    def menu(self, side: str) -> Select:
        return Select(self.box.find_element(By.CSS_SELECTOR, f"select.{side}"))

    def loaded(self, side: str) -> bool:
        return self.browser.execute_async_script(
            "const [image, done] = arguments;"
            "image.decode().then(() => done(image.naturalWidth > 0), () => done(false));",
            self.image(side),
        )

    def share(self) -> float:
        """How much of the left picture is to be seen, by what cuts it off."""
        cut = self.image("left").value_of_css_property("clip-path")
        right = re.fullmatch(r"inset\(0(?:px)? (.*) 0(?:px)? 0(?:px)?\)", cut)
        assert right, cut
        percents = [float(p) for p in re.findall(r"([\d.]+)%", right[1])]
        return (percents[1] if len(percents) == 2 else 100.0 - percents[0]) / 100.0

    def bar(self) -> float:
        """Where the line is, as a share of the width."""
        view = self.box.find_element(By.CSS_SELECTOR, ".view").rect
        bar = self.box.find_element(By.CSS_SELECTOR, ".bar").rect
        return (bar["x"] + bar["width"] / 2 - view["x"]) / view["width"]


@pytest.fixture
def page(browser, gallery):
    browser.get_log("browser")  # empties it
    browser.get((gallery.folder / "index.html").as_uri())
    return browser


def test_nothing_fails_and_nothing_is_fetched(page, gallery):
    assert page.get_log("browser") == []
    entries = "return performance.getEntriesByType('resource').map((e) => e.name)"
    shown = "return [...document.images].map((i) => i.currentSrc)"
    addresses = page.execute_script(shown) + page.execute_script(entries)
    folder = gallery.folder.as_uri()
    assert len(addresses) > 6
    assert all(a.startswith((folder, "data:")) for a in addresses), addresses
    assert page.execute_script("return document.querySelectorAll('link[rel=stylesheet], "
                               "script[src], iframe').length") == 0  # fmt: skip


def test_all_pictures_load(page, gallery):
    for figure in gallery.numbers["figures"]:
        compare = Compare(page, figure["name"])
        for picture in figure["pictures"]:
            compare.menu("left").select_by_value(picture["key"])
            assert compare.file("left") == picture["file"]
            assert compare.loaded("left") and compare.loaded("right")
            size = page.execute_script(
                "return [arguments[0].naturalWidth, arguments[0].naturalHeight]",
                compare.image("left"),
            )
            assert size == [figure["width"], figure["height"]]
    assert page.get_log("browser") == []


def test_the_slider_is_dragged(page):
    compare = Compare(page, "glass")
    assert compare.share() == pytest.approx(0.5) == compare.bar()
    width = compare.slider.rect["width"]
    before = compare.box.find_element(By.CSS_SELECTOR, ".view").screenshot_as_png
    drag = ActionChains(page).move_to_element(compare.slider).click_and_hold()
    drag.move_by_offset(round(-0.3 * width), 0).release().perform()
    assert compare.share() == pytest.approx(0.2, abs=0.03)
    assert compare.bar() == pytest.approx(compare.share(), abs=0.01)
    assert compare.box.find_element(By.CSS_SELECTOR, ".view").screenshot_as_png != before
    # A click goes there at once.
    ActionChains(page).move_to_element_with_offset(
        compare.slider, round(0.4 * width), 0
    ).click().perform()
    assert compare.share() == pytest.approx(0.9, abs=0.03)


def test_the_keyboard_moves_it(page):
    compare = Compare(page, "classes")
    ActionChains(page).send_keys_to_element(compare.slider, Keys.ARROW_RIGHT * 4).perform()
    assert page.switch_to.active_element == compare.slider
    assert 0.5 < compare.share() < 0.6
    assert compare.bar() == pytest.approx(compare.share(), abs=0.01)
    compare.slider.send_keys(Keys.HOME)
    assert compare.share() == 0.0
    compare.slider.send_keys(Keys.END)
    assert compare.share() == 1.0
    assert compare.slider.get_attribute("aria-valuetext").startswith("100 per cent ")
    # The other figures have stayed.
    assert Compare(page, "glass").share() == 0.5


def test_everything_has_a_label(page):
    for control in page.find_elements(By.CSS_SELECTOR, "input, select"):
        assert control.accessible_name.strip(), control.get_attribute("outerHTML")
    for image in page.find_elements(By.TAG_NAME, "img"):
        assert image.get_attribute("alt") or image.find_element(By.XPATH, "..").text


def test_the_menus_choose(page, gallery):
    compare = Compare(page, "glass")
    assert compare.file("left") == gallery.picture("glass", "samples-pt")["file"]
    for side, key in (("left", "time-lt"), ("right", "reference")):
        compare.menu(side).select_by_value(key)
        picture = gallery.picture("glass", key)
        assert compare.file(side) == picture["file"]
        assert compare.loaded(side)
        tag = compare.box.find_element(By.CSS_SELECTOR, f".tag.of-{side}").text
        assert tag.startswith(picture["label"])
    assert number(gallery.picture("glass", "time-lt")["relmse"]) in compare.box.text
    # Errors instead of pictures; a reference has none.
    compare.box.find_element(By.CSS_SELECTOR, "input[type=checkbox]").click()
    assert compare.file("left") == gallery.picture("glass", "time-lt")["error_file"]
    assert compare.file("right") == gallery.picture("glass", "reference")["file"]
    assert compare.loaded("left")


def test_the_errors_are_those_of_the_file(page, gallery):
    rows = 0
    for figure in gallery.numbers["figures"]:
        section = page.find_element(By.ID, figure["name"])
        for picture in figure["pictures"]:
            if "relmse" not in picture:
                continue
            row = section.find_element(By.CSS_SELECTOR, f"tr[data-key='{picture['key']}']")
            for name in ("rmse", "relmse", "trimmed"):
                shown = row.find_element(By.CSS_SELECTOR, f".{name}").text
                assert shown == number(picture[name])
                assert float(shown) == pytest.approx(picture[name], rel=0.06)
            rows += 1
    assert rows == 7 + 4
    assert len(page.find_elements(By.CSS_SELECTOR, "svg.curve path")) == 4 + 4


def test_it_fits_a_telephone(page):
    page.set_window_size(500, 900)
    try:
        body = page.execute_script(
            "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        assert body[0] <= body[1]
    finally:
        page.set_window_size(1280, 1000)
