#!/usr/bin/env python3
"""Compares runs of two builds on one machine: nothing that surehit does may have become slower.

Each build's CSV files are of equal runs, best alternated. Of each figure the least time counts. The exit status is 1 if
the time before, over that after, is below --least anywhere.
"""

import argparse
import csv
import math
import statistics
import sys

CELL = ["instruction_set", "table", "mesh", "paths", "question", "contender", "measure"]


def least_times(paths):
    """The least time of each figure of surehit's in these files, by its cell."""
    times = {}
    for path in paths:
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                cell = tuple(row[column] for column in CELL)
                is_time = row["measure"].startswith("ns per ") or row["measure"].endswith(" ns")
                if is_time and row["contender"].startswith("surehit"):
                    times[cell] = min(times.get(cell, math.inf), float(row["min"]))
    return times


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", nargs="+", required=True, metavar="CSV")
    parser.add_argument("--after", nargs="+", required=True, metavar="CSV")
    parser.add_argument("--least", type=float, default=0.98, metavar="RATIO", help="0.98 without this")
    request = parser.parse_args()
    before, after = least_times(request.before), least_times(request.after)
    missing = [cell for cell in before if cell not in after]
    if missing or not before:
        what = " ".join(missing[0]) if missing else "any time of surehit's"
        sys.exit(f"compare_runs.py: not in both runs: {what}")
    ratios = {cell: before[cell] / after[cell] for cell in before}
    slower = sorted((ratio, cell) for cell, ratio in ratios.items() if ratio < request.least)
    for ratio, cell in slower:
        print(f"{ratio:.3f}  {', '.join(cell)}")
    mean = statistics.geometric_mean(ratios.values())
    print(f"{len(slower)} of {len(ratios)} figures are below {request.least}; their mean is {mean:.3f}")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
