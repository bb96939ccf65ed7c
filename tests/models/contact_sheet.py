#!/usr/bin/python3
"""contact_sheet.py ROOT: the pictures of all models side by side, by their ids, as docs/pictures/contact_sheet.png."""
import html
import pathlib
import sys
import tempfile
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
from browser import opened  # noqa: E402

COLUMNS = 8
STYLE = f"""
body {{ margin: 0; padding: 10px; background: #14161a; color: #e8eaee; font: 13px/1.3 "DejaVu Sans", sans-serif; display: grid;
  grid-template-columns: repeat({COLUMNS}, 200px); gap: 10px; width: max-content; }}
figure {{ margin: 0; }}
img {{ display: block; width: 200px; height: 150px; border-radius: 5px; }}
figcaption {{ padding: 4px 2px 0; color: #a3abb8; font-size: 11px; }}
b {{ color: #fff; font-size: 13px; }}
"""


def page_of(root):
    models = tomllib.loads((root / "docs/models.toml").read_text())
    figures = "".join(
        f'<figure><img src="{(root / "docs/pictures/models" / name).with_suffix(".png").as_uri()}">'
        f'<figcaption><b>{name}</b> {html.escape(model["title"])}</figcaption></figure>' for name, model in models.items())
    return f"<!DOCTYPE html><meta charset=utf-8><link rel=icon href='data:,'><style>{STYLE}</style>{figures}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "sheet.html"
        page.write_text(page_of(root))
        with opened(page, 1800, 1400) as driver:
            assert driver.execute_script("return [...document.images].every(image => image.complete && image.naturalWidth > 0)")
            driver.find_element("tag name", "body").screenshot(str(root / "docs/pictures/contact_sheet.png"))


main()
