#!/usr/bin/python3
"""report_in_browser.py GOBO [SCREENSHOT]: what a reader does with a study's report, done in a browser."""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
from browser import opened  # noqa: E402

EFFECTS = ["directional=1 specular=blinn", "fog=linear point=1"]


def make_report(gobo, folder):
    command = [gobo, "study", "lit", "-o", folder, "--quick", "-q"]
    for effects in EFFECTS:
        command += ["--effects", effects]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return pathlib.Path(folder) / "index.html"


def shown_figures(driver):
    return [figure for figure in driver.find_elements("css selector", "#scatters figure") if figure.is_displayed()]


def bright_points(driver):
    return shown_figures(driver)[0].find_elements("css selector", ".point:not(.dimmed)")


def pick(driver, name, label):
    from selenium.webdriver.support.ui import Select

    Select(driver.find_element("id", name)).select_by_visible_text(label)


def is_on_top(driver, point):
    """Whether the middle of a point is not covered by another one: nearly equal errors at equal costs coincide."""
    return driver.execute_script(
        "arguments[0].scrollIntoView({block: 'center'});"
        "const box = arguments[0].getBoundingClientRect();"
        "const x = box.x + box.width / 2, y = box.y + box.height / 2;"
        "return [-2, 0, 2].every(dx => [-2, 0, 2].every(dy =>"
        "  arguments[0].contains(document.elementFromPoint(x + dx, y + dy))));",
        point)


def hovering_names_the_key(driver):
    from selenium.webdriver import ActionChains

    tip = driver.find_element("id", "tip")
    assert not tip.is_displayed(), "the tip is shown before anything is pointed at"
    uncovered = [point for point in bright_points(driver) if is_on_top(driver, point)]
    assert len(uncovered) >= 3, "points cover one another"
    for point in uncovered[-3:]:
        # From elsewhere: a point that is pointed at grows over its neighbours.
        ActionChains(driver).move_to_element(driver.find_element("tag name", "h1")).perform()
        ActionChains(driver).scroll_to_element(point).move_to_element(point).perform()
        key = point.get_attribute("data-key")
        assert tip.is_displayed() and tip.text.splitlines()[0] == key, f"pointing at '{key}' shows '{tip.text}'"
        assert "error" in tip.text and "additions" in tip.text, tip.text
    ActionChains(driver).move_to_element(driver.find_element("tag name", "h1")).perform()
    assert not tip.is_displayed(), "the tip stays"


def keyboards_reach_points(driver):
    point = bright_points(driver)[-1]
    driver.execute_script("arguments[0].focus()", point)
    assert driver.find_element("id", "tip").text.startswith(point.get_attribute("data-key"))
    driver.execute_script("document.activeElement.blur()")


def picking_shows_one_scatter(driver):
    from selenium.webdriver.support.ui import Select

    scenes = [option.text for option in Select(driver.find_element("id", "scene")).options]
    assert len(scenes) >= 3, scenes
    for effects in EFFECTS:
        for scene in scenes:
            pick(driver, "effects", effects)
            pick(driver, "scene", scene)
            figures = shown_figures(driver)
            assert len(figures) == 1 and figures[0].get_attribute("data-effects") == effects, (effects, scene)
            assert all(set(effects.split()) <= set(point.get_attribute("data-key").split()) for point in bright_points(driver))
            assert f"{len(bright_points(driver))} permutations" == driver.find_element("id", "shown").text
    pick(driver, "effects", EFFECTS[0])
    pick(driver, "scene", scenes[0])


def picking_a_feature_dims_the_others(driver):
    everything = len(bright_points(driver))
    pick(driver, "feature", "shading")
    assert len(bright_points(driver)) == everything, "a feature alone dims nothing"
    pick(driver, "value", "vertex")
    keys = [point.get_attribute("data-key").split() for point in bright_points(driver)]
    assert 0 < len(keys) < everything and all("shading=vertex" in key for key in keys), keys
    pick(driver, "value", "fragment")
    keys = [point.get_attribute("data-key").split() for point in bright_points(driver)]
    assert 0 < len(keys) < everything and not any(part.startswith("shading=") for key in keys for part in key), keys
    pick(driver, "feature", "any feature")
    assert len(bright_points(driver)) == everything


def nothing_is_fetched(driver):
    fetched = driver.execute_script("return performance.getEntriesByType('resource').map(entry => entry.name)")
    fetched = [name for name in fetched if not name.startswith("data:")]
    assert not fetched, f"the page does not stand alone: {fetched}"


def pictures_show(driver):
    widths = driver.execute_script("return [...document.images].map(image => image.naturalWidth)")
    assert len(widths) >= 3 and all(width > 0 for width in widths), widths


def nothing_is_wider_than_the_page(driver):
    width, shown = driver.execute_script("const page = document.documentElement; return [page.scrollWidth, page.clientWidth]")
    assert width <= shown, f"the page is {width} wide, the window shows {shown}"


def guards_have_their_prices(driver):
    rows = driver.find_elements("css selector", "#guards ~ table tr")
    assert len(rows) > 10 and "ratio" in rows[0].text, "no table of the guards' prices"


def main():
    with tempfile.TemporaryDirectory() as folder:
        page = make_report(sys.argv[1], folder)
        with opened(page) as driver:
            for check in (hovering_names_the_key, keyboards_reach_points, picking_shows_one_scatter,
                          picking_a_feature_dims_the_others, nothing_is_fetched, pictures_show,
                          nothing_is_wider_than_the_page, guards_have_their_prices):
                check(driver)
                print("ok", check.__name__.replace("_", " "))
            if len(sys.argv) > 2:
                driver.save_screenshot(sys.argv[2])


main()
