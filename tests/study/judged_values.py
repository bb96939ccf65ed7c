#!/usr/bin/env python3
"""judged_values.py GOBO ROOT: the quality values of the shipped study, judged by its fronts.

One that is on no front, by additions or by the cycles of any chip, is to be excluded by default, unless it is the most accurate of
its feature (which may be there for inputs that no scene has) or docs/study.md says which single scene wants it.
"""
import subprocess
import sys
import tempfile
import tomllib

# The shipped study holds all scenes together; this one is on the front of one scene of its own.
WANTED_BY_ONE_SCENE = {("power", "squaring")}

# The study evaluates GLSL 4.50, which has no mediump: gobo study --worst searches it.
OF_OTHER_DIALECTS = {("precision", "mediump_light")}


def main(gobo, root):
    with tempfile.NamedTemporaryFile(suffix=".html") as page:
        told = subprocess.run([gobo, "study", "lit", "--fronts", page.name, "--quiet"], capture_output=True, text=True, check=True).stdout
    with open(root + "/templates/lit.toml", "rb") as file:
        features = tomllib.load(file)["features"]
    table = told[told.index("| feature | value | matters in |"):].splitlines()[2:]
    judged = {}
    for line in table:
        feature, value, matters, *fronts = [cell.strip(" `") for cell in line.strip("|").split("|")]
        judged[feature, value] = (int(matters), [int(count) for count in fronts])
    problems = []
    for (feature, value), (matters, fronts) in judged.items():
        is_excluded = value in features[feature].get("excluded", [])
        is_accurate = value == features[feature]["values"][0]
        if not any(fronts) and not (is_excluded or is_accurate or (feature, value) in WANTED_BY_ONE_SCENE):
            problems.append(f"{feature}={value} is on no front of {matters} and not excluded")
        if any(fronts) and is_excluded:
            problems.append(f"{feature}={value} is excluded, and on {max(fronts)} fronts of {matters}")
    for feature, entries in features.items():
        for value in entries.get("excluded", []):
            if (feature, value) not in judged and (feature, value) not in OF_OTHER_DIALECTS:
                problems.append(f"{feature}={value} is excluded, and the study has not measured it")
    print(f"{len(judged)} values judged", *problems, sep="\n")
    return 1 if problems or not judged else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
