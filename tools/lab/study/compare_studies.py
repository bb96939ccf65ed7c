#!/usr/bin/env python3
"""compare_studies.py FIRST.csv SECOND.csv: whether two runs of one study tell the same.

Operation counts and the front on weighted cost must be the same. By time, a key that is on one front only must be one whose
range of times overlaps that of a key which is as accurate: no measurable difference. Exit status 1 where not.
"""
import csv
import sys

EXACT = ["error_max", "error_rms", "cost", "front", "fragment_operations", "vertex_operations"]


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {(row["effects"], row["key"], row["scene"]): row for row in csv.DictReader(file)}


def differences(first, second):
    if first.keys() != second.keys():
        yield f"{len(first.keys() ^ second.keys())} rows are in one of them only"
    for place in sorted(first.keys() & second.keys()):
        for column in EXACT:
            if first[place][column] != second[place][column]:
                yield f"{' | '.join(place)}: {column} is {first[place][column]} and {second[place][column]}"


def time_range(row):
    return float(row["time_ns_q1"]), float(row["time_ns_q3"])


def overlaps_a_rival(row, rivals):
    """Whether a key that is as accurate has a range of times that shares a value with the row's."""
    low, high = time_range(row)
    return any(
        rival["key"] != row["key"]
        and float(rival["error_max"]) <= float(row["error_max"])
        and time_range(rival)[0] <= high
        and low <= time_range(rival)[1]
        for rival in rivals
    )


def fronts_by_time(first, second):
    """Combinations of effects that both runs rank by time: rows of both, by key."""
    ranked = {}
    for place in sorted(first.keys() & second.keys()):
        if first[place]["time_front"] and second[place]["time_front"]:
            ranked.setdefault(place[0], []).append((first[place], second[place]))
    return ranked


def main():
    first, second = rows_of(sys.argv[1]), rows_of(sys.argv[2])
    problems = list(differences(first, second))
    fronts = sum(row["front"] == "yes" and row["scene"] == "*" for row in first.values())
    print(f"{len(first)} rows, {fronts} keys on the fronts by cost: {len(problems)} differences")
    members = changed = 0
    ranked = fronts_by_time(first, second)
    for effects, pairs in ranked.items():
        for one, other in pairs:
            members += one["time_front"] == "yes"
            if one["time_front"] == other["time_front"]:
                continue
            changed += 1
            if not overlaps_a_rival(one, [a for a, _ in pairs]) and not overlaps_a_rival(other, [b for _, b in pairs]):
                problems.append(f"{effects} | {one['key']}: on one front by time only, yet no range overlaps")
    print(f"{len(ranked)} combinations ranked by time in both, {members} keys on these fronts: {changed} on one front only, their ranges overlapping others'")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


sys.exit(main())
