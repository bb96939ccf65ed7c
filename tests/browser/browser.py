"""Pages opened in a headless Chromium, for tests. Where none is installed a test is skipped, with the reason."""
import contextlib
import pathlib
import shutil
import sys

SKIPPED = 77  # what CTest is told a skipped test's exit status is


def skip(reason):
    print(f"skipped: {reason}; tools/setup.sh installs chromium, chromium-driver and python3-selenium where it can")
    sys.exit(SKIPPED)


@contextlib.contextmanager
def opened(path, width=1280, height=1000, draws=False):
    """A driver that has the page open; one that draws does so by SwiftShader, on the processor. Raises AssertionError at the end where the page's console holds an error."""
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        from selenium.webdriver.common.utils import is_connectable
    except ImportError:
        skip("python3-selenium is not installed")

    class NumericService(Service):
        """Reached by its number: a system without /etc/hosts does not know the name localhost."""

        @property
        def service_url(self):
            return f"http://127.0.0.1:{self.port}"

        def is_connectable(self):
            return is_connectable(self.port, "127.0.0.1")

    browser, driver_program = shutil.which("chromium"), shutil.which("chromedriver")
    if not browser or not driver_program:
        skip("chromium is not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--window-size={width},{height}",
                     "--allow-file-access-from-files", *(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"] if draws else [])):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=NumericService(driver_program), options=options)
    try:
        driver.get(pathlib.Path(path).resolve().as_uri())
        yield driver
        errors = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not errors, f"the page's console holds errors: {errors}"
    finally:
        driver.quit()
