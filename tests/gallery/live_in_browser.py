#!/usr/bin/python3
"""live_in_browser.py GOBO [SCREENSHOT]: what a reader does with a page that draws live, done in a browser."""
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
from browser import opened  # noqa: E402

# Every kind of uniform, attribute and texture: no two of these features but with one another's defaults, so some are not there.
SELECTION = ["--all", "--over", "fog,ambient,material,directional,directional_shadows", "--size", "80x60", "--where",
             "directional == 1 && directional_shadows <= 1 && (fog == none || fog == linear) && (ambient == global || ambient == image)"
             " && (fog == none || directional_shadows == 0)"]


def make_page(gobo, folder):
    subprocess.run([gobo, "render", "lit", "-o", folder, "-q", "--page", *SELECTION], check=True, stdout=subprocess.PIPE)
    page = pathlib.Path(folder) / "alone" / "live.html"
    page.parent.mkdir()
    (pathlib.Path(folder) / "live.html").rename(page)  # without the files of the other page beside it
    return page


def run(driver, script, *arguments):
    return driver.execute_script(script, *arguments)


def error_text(driver):
    return driver.find_element("id", "error").text


def picture(driver):
    """The canvas as bytes."""
    return bytes(run(driver, "const pixels = new Uint8Array(4 * canvas.width * canvas.height);"
                             "gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels); return [...pixels]"))


def slide(driver, name, value):
    run(driver, "const slider = document.getElementsByName(arguments[0])[0]; slider.value = arguments[1];"
                "slider.dispatchEvent(new Event('input'))", name, value)


def every_permutation_is_what_the_interpreter_says(driver):
    count = run(driver, "return data.permutations.length")
    assert count == 3 * 2 * 2, count
    for number in range(count):
        key = run(driver, "choose(data.permutations[arguments[0]]); return state.permutation.key", number)
        found = re.fullmatch(r"Beside the interpreter: half of the pixels are off by at most (\S+), 99 % by (\S+), all by (\S+)\.", error_text(driver))
        assert found, (key, error_text(driver))
        print(" ", key, *found.groups())
        # SwiftShader places vertices on sixteenths of a pixel, so a pixel shows what lies up to half of one beside it.
        assert float(found[1]) <= 1e-3 and float(found[2]) <= 2e-2, (key, error_text(driver))


def another_value_is_another_picture(driver):
    run(driver, "choose(data.permutations.find(({ key }) => key.includes('fog=linear')))")
    before = picture(driver)
    assert len(set(before)) > 50, "an empty picture"
    slide(driver, "DirectionalLights.lights[0].color[0]", 0)
    assert picture(driver) != before and "Values were changed" in error_text(driver)
    driver.find_element("id", "reset").click()
    assert picture(driver) == before and "Beside the interpreter" in error_text(driver)


def ranges_are_the_domains(driver):
    low, high = run(driver, "const slider = document.getElementsByName('Material.diffuse[0]')[0]; return [slider.min, slider.max]")
    assert (low, high) == ("0", "1"), (low, high)
    assert not run(driver, "return document.getElementsByName('Transform.modelView[0]').length"), "matrices are not to be slid"


def the_heat_map_shows_where_it_is_off(driver):
    brightest = lambda: max(value for i, value in enumerate(picture(driver)) if i % 4 < 3)
    run(driver, "element('heat').click()")
    near = sum(picture(driver))
    slide(driver, "DirectionalLights.lights[0].color[0]", 0)
    assert sum(picture(driver)) > near and brightest() == 255
    driver.find_element("id", "reset").click()
    assert sum(picture(driver)) == near
    run(driver, "element('heat').click()")


def features_switch_where_they_were_built(driver):
    from selenium.webdriver.support.ui import Select

    Select(driver.find_element("name", "fog")).select_by_visible_text("none")
    assert "fog" not in driver.find_element("id", "key").text
    Select(driver.find_element("name", "directional_shadows")).select_by_visible_text("1")
    assert "directional_shadows=1" in driver.find_element("id", "key").text
    built = {option.text: option.is_enabled() for option in Select(driver.find_element("name", "fog")).options}
    assert built == {"none": True, "linear": False}, built
    assert not driver.find_elements("name", "point"), "a feature with one value offers nothing to choose"


def nothing_comes_from_elsewhere(driver):
    fetched = run(driver, "return performance.getEntriesByType('resource').map(entry => entry.name)")
    assert all(name.startswith("data:") for name in fetched), fetched


def main():
    with tempfile.TemporaryDirectory() as folder:
        with opened(make_page(sys.argv[1], folder), draws=True) as driver:
            for check in (every_permutation_is_what_the_interpreter_says, another_value_is_another_picture, ranges_are_the_domains,
                          the_heat_map_shows_where_it_is_off, features_switch_where_they_were_built, nothing_comes_from_elsewhere):
                check(driver)
                print("ok", check.__name__.replace("_", " "))
            if len(sys.argv) > 2:
                driver.save_screenshot(sys.argv[2])


main()
