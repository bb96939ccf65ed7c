#!/usr/bin/python3
"""pictures.py GOBO ROOT: draws the example of each model of docs/models.toml as docs/pictures/models/ID.png."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib


def draw(gobo, family, key, picture):
    with tempfile.TemporaryDirectory() as folder:
        command = [gobo, "render", family, "--key", key, "--size", "200x150", "--smooth", "4", "-o", folder, "-q"]
        drawn = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
        shutil.move(drawn, picture)


def main():
    gobo, root = sys.argv[1], pathlib.Path(sys.argv[2])
    models = tomllib.loads((root / "docs/models.toml").read_text())
    folder = root / "docs/pictures/models"
    folder.mkdir(parents=True, exist_ok=True)
    for name, model in models.items():
        draw(gobo, model.get("family", "lit"), model["key"], folder / f"{name}.png")


main()
