#!/usr/bin/env python3
"""recheck_study.py GOBO STUDY: the cycles of a shipped study against those of the Mesa that is installed, for the chips it knows.

Another version must rank alike: Spearman's correlation at least 0.98 for each chip; of two qualities of the same effects that are
more than 5 % apart in the study neither changes its place, and of any two keys none that are so far apart in both versions. The same
version, or one in a folder that GOBO_MESA names (tools/fetch_mesa.sh), must give the same numbers. Ends with 77 where no driver is
installed.
"""
import csv
import io
import os
import subprocess
import sys

FAR = 1.05
LEAST_CORRELATION = 0.98


def ranks(values):
    order = sorted(range(len(values)), key=values.__getitem__)
    result = [0.0] * len(values)
    first = 0
    while first < len(order):
        last = first
        while last + 1 < len(order) and values[order[last + 1]] == values[order[first]]:
            last += 1
        for i in range(first, last + 1):
            result[order[i]] = (first + last) / 2
        first = last + 1
    return result


def correlation(first, second):
    a, b = ranks(first), ranks(second)
    mean = sum(a) / len(a)
    spread = lambda x: sum((v - mean) ** 2 for v in x) ** 0.5
    return sum((x - mean) * (y - mean) for x, y in zip(a, b)) / (spread(a) * spread(b))


def swapped(rows):
    """Pairs that change places: those of the same effects, and of any that are far apart in both versions."""
    found = []
    for one in rows:
        for other in rows:
            shipped = one["shipped"] / other["shipped"]
            here = one["here"] / other["here"]
            within = one["effects"] == other["effects"]
            if shipped > FAR and here < (1 if within else 1 / FAR):
                found.append(f"{one['key']} against {other['key']}: {shipped:.3f} in the study, {here:.3f} here")
    return found


def check(gpu, shipped, here):
    rows = []
    for old, new in zip(shipped, here):
        if old[f"cycles_{gpu}"] and new[f"cycles_{gpu}"]:
            rows.append({"effects": old["effects"], "key": old["key"], "shipped": float(old[f"cycles_{gpu}"]),
                         "here": float(new[f"cycles_{gpu}"])})
    if len(rows) < 0.9 * sum(bool(row[f"cycles_{gpu}"]) for row in shipped):
        return [f"only {len(rows)} keys have cycles in both"]
    driver = here[0][f"driver_{gpu}"]
    if driver == shipped[0][f"driver_{gpu}"]:
        problems = [f"{row['key']}: {row['shipped']} in the study, {row['here']} here" for row in rows
                    if row["shipped"] != row["here"]]
        print(f"{gpu}, {driver}: {len(rows)} keys, {len(problems)} not as in the study")
        return problems
    rank = correlation([row["shipped"] for row in rows], [row["here"] for row in rows])
    problems = swapped(rows)
    print(f"{gpu}, {driver} against {shipped[0][f'driver_{gpu}']}: {len(rows)} keys, rank correlation {rank:.5f}, "
          f"{len(problems)} pairs change places")
    if rank < LEAST_CORRELATION:
        problems.append(f"rank correlation {rank:.5f}")
    return problems


def cost(gobo, arguments):
    return subprocess.run([gobo, "cost"] + arguments, capture_output=True, text=True)


def main(gobo, study):
    folder = os.environ.get("GOBO_MESA")
    driver = ["--driver", folder] if folder else []
    listed = cost(gobo, ["--gpu", "list"] + driver)
    if listed.returncode != 0:
        print("SKIPPED: " + listed.stderr)
        return 77
    known = {line.split()[0] for line in listed.stdout.splitlines() if not line.rstrip().endswith(" -")}
    with open(study, newline="") as file:
        shipped = list(csv.DictReader(file))
    gpus = [name[len("cycles_"):] for name in shipped[0] if name.startswith("cycles_")]
    gpus = [gpu for gpu in gpus if gpu in known]
    if not gpus:
        print("SKIPPED: the installed Mesa knows no chip of the study")
        return 77
    measured = cost(gobo, ["lit", "--study", study, "--gpu", ",".join(gpus)] + driver)
    if measured.returncode != 0:
        print(measured.stderr)
        return 1
    here = list(csv.DictReader(io.StringIO(measured.stdout)))
    failed = False
    for gpu in gpus:
        problems = check(gpu, shipped, here)
        failed = failed or bool(problems)
        for problem in problems[:20]:
            print(f"  {gpu}: {problem}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
