#!/usr/bin/python3
"""gallery_in_browser.py GOBO [SCREENSHOT]: what a reader does with a gallery's page, done in a browser."""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
from browser import opened  # noqa: E402

# Fog, highlights, a table of materials, a cutout, light from images and shadows: every kind of texture is looked up.
SELECTION = ["--all", "--over", "fog,specular,ambient,cutout,directional,directional_shadows", "--size", "160x120", "--where",
             "directional == 1 && directional_shadows <= 1 && (ambient == global || ambient == image) && (fog == none || fog == linear)"
             " && (specular == none || specular == blinn)"]
KEYS = 2 ** 5


def make_gallery(gobo, folder):
    command = [gobo, "render", "lit", "-o", folder, "-q", *SELECTION]
    printed = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    assert len(printed) == 1 + KEYS and printed[0].endswith("/index.html"), printed
    return pathlib.Path(printed[0])


def cards(driver):
    return driver.find_elements("css selector", "#cards .card")


def keys(driver):
    return [card.find_element("class name", "key").text for card in cards(driver)]


def pick(driver, name, label):
    from selenium.webdriver.support.ui import Select

    Select(driver.find_element("name", name)).select_by_visible_text(label)


def wait_for(what, driver, condition):
    from selenium.webdriver.support.ui import WebDriverWait

    WebDriverWait(driver, 60).until(condition, what)


def wait_for_images(driver, selector):
    wait_for(f"images of {selector}", driver, lambda _: driver.execute_script(
        "const images = [...document.querySelectorAll(arguments[0])];"
        "return images.length > 0 && images.every(image => image.complete && image.naturalWidth === 160)", selector))


def every_thumbnail_loads(driver):
    assert len(cards(driver)) == KEYS, len(cards(driver))
    for card in cards(driver)[::4]:
        driver.execute_script("arguments[0].scrollIntoView()", card)
    wait_for_images(driver, "#cards img")
    assert driver.find_element("id", "count").text == f"{KEYS} of {KEYS} permutations"


def cards_tell_error_and_cost(driver):
    for card in cards(driver):
        figures = card.find_element("class name", "figures").text.split()
        assert figures[0] == "error" and 0 < float(figures[1].rstrip(",")) < 1e-2, figures
        assert figures[2] == "cost" and float(figures[3]) > 0, figures


def filters_narrow_and_combine(driver):
    pick(driver, "fog", "linear")
    assert len(cards(driver)) == KEYS // 2 and all("fog=linear" in key for key in keys(driver)), keys(driver)
    pick(driver, "specular", "none")
    assert len(cards(driver)) == KEYS // 4, keys(driver)
    assert not any("specular" in key for key in keys(driver)), "the default is not named in a key"
    pick(driver, "directional_shadows", "1")
    assert len(cards(driver)) == KEYS // 8 and all("directional_shadows=1" in key for key in keys(driver)), keys(driver)
    assert driver.find_element("id", "count").text == f"{KEYS // 8} of {KEYS} permutations"
    assert not driver.find_elements("name", "point"), "a feature with one value offers nothing to choose"


def the_address_keeps_the_view(driver):
    before = keys(driver)
    driver.refresh()
    assert keys(driver) == before, "a reload forgets the filters"
    for name in ("fog", "specular", "directional_shadows"):
        pick(driver, name, "any")
    assert len(cards(driver)) == KEYS


def sorting_orders_by_cost(driver):
    pick(driver, "sort", "cost")
    costs = [float(card.find_element("class name", "figures").text.split()[3]) for card in cards(driver)]
    assert costs == sorted(costs, reverse=True) and costs[0] > costs[-1], costs
    pick(driver, "sort", "key")


def a_click_shows_actual_expected_and_error(driver):
    from selenium.webdriver.common.keys import Keys

    dialog = driver.find_element("id", "detail")
    assert not dialog.is_displayed()
    card = cards(driver)[5]
    key = card.find_element("class name", "key").text
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", card)
    card.click()
    assert dialog.is_displayed() and driver.find_element("id", "detail-key").text == key
    wait_for_images(driver, "#pictures img")
    captions = [caption.text.split(":")[0] for caption in driver.find_elements("css selector", "#pictures figcaption")]
    assert captions == ["actual", "expected", "error"], captions
    assert f"--key '{key}'" in driver.find_element("id", "detail-command").text
    driver.find_element("tag name", "body").send_keys(Keys.ESCAPE)
    wait_for("the dialog's end", driver, lambda _: not dialog.is_displayed())


def nothing_comes_from_elsewhere(driver):
    fetched = driver.execute_script("return performance.getEntriesByType('resource').map(entry => entry.name)")
    assert all(name.startswith(("file:", "data:")) for name in fetched), fetched


def main():
    with tempfile.TemporaryDirectory() as folder:
        with opened(make_gallery(sys.argv[1], folder)) as driver:
            for check in (every_thumbnail_loads, cards_tell_error_and_cost, filters_narrow_and_combine, the_address_keeps_the_view,
                          sorting_orders_by_cost, a_click_shows_actual_expected_and_error, nothing_comes_from_elsewhere):
                check(driver)
                print("ok", check.__name__.replace("_", " "))
            if len(sys.argv) > 2:
                driver.save_screenshot(sys.argv[2])


main()
