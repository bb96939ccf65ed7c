#!/usr/bin/python3
"""pictures.py GOBO ROOT: draws the example of each model of docs/models.toml as docs/pictures/models/ID.png."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib


def draw(gobo, family, models, folder):
    """The pictures of a family's models, by one command. Files are named after keys, long ones by a hash: those are drawn alone."""
    with tempfile.TemporaryDirectory() as drawn:
        keys = [option for model in models.values() for option in ("--key", model["key"])]
        command = [gobo, "render", family, *keys, "--size", "200x150", "--smooth", "4", "-o", drawn, "-q"]
        files = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.split()
        for name, model in models.items():
            picture = files[0] if len(files) == 1 else f"{drawn}/{model['key'].replace('=', '-').replace(' ', '+')}.png"
            shutil.copy(picture, folder / f"{name}.png")


def main():
    gobo, root = sys.argv[1], pathlib.Path(sys.argv[2])
    models = tomllib.loads((root / "docs/models.toml").read_text())
    folder = root / "docs/pictures/models"
    folder.mkdir(parents=True, exist_ok=True)
    for family in sorted({model.get("family", "lit") for model in models.values()}):
        own = root / f"tests/ubershader/{family}.toml"  # a family that is not shipped
        draw(gobo, str(own) if own.exists() else family, {name: model for name, model in models.items() if model.get("family", "lit") == family}, folder)


main()
