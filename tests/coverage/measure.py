#!/usr/bin/env python3
"""Says which lines of broadphase/ and collision/ no test runs.

Builds the library and its tests with gcov's counters, runs a share of the random cases of each test, and lists each
line that did not run though the compiler has code for it; if there is one, the exit code is 1.
"""

import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[2]
libraries = [root / "broadphase", root / "collision"]
# What asks the library itself; the rest of the suite asks programs that are built on it.
suites = ["broadphase", "collision", "crosscheck", "grid"]
# One instruction set runs the lines of all, for there is one body for them; what is inlined is not always counted where
# it stands; warnings are for other builds.
flags = "-Og -fno-inline --coverage -march=native -DHWY_COMPILE_ONLY_STATIC -w"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=root / "build/coverage", help="where to build")
    parser.add_argument("--percent", type=int, default=10, help="of the random cases")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    return parser.parse_args()


def run(*command, **more):
    subprocess.run([str(word) for word in command], check=True, **more)


def run_tests(build, percent, jobs):
    run("cmake", "-G", "Ninja", "-S", root, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_CXX_FLAGS_RELEASE={flags}", "-DSUREHIT_BUILD_BENCHMARKS=OFF", stdout=subprocess.DEVNULL)
    run("ninja", "-C", build, "-j", jobs, *[f"tests/{suite}/all" for suite in suites])
    for counts in build.glob("**/*.gcda"):
        counts.unlink()
    for suite in suites:
        # How much stack a query takes is asked of optimized builds.
        run("ctest", "--test-dir", build / "tests" / suite, "--parallel", jobs, "--output-on-failure", "--progress",
            "--exclude-regex", "^QueryStack", env=dict(os.environ, SUREHIT_TEST_PERCENT=str(percent)))


def line_counts(build):
    """How often each line of the libraries ran, in whatever object it was compiled into."""
    counts = collections.defaultdict(collections.Counter)
    for data in build.glob("**/*.gcda"):
        output = subprocess.run(["gcov", "--json-format", "--stdout", data], cwd=build, capture_output=True, check=True)
        for document in filter(None, output.stdout.split(b"\n")):
            for file in json.loads(document)["files"]:
                path = pathlib.Path(build, file["file"]).resolve()
                if not any(path.is_relative_to(library) for library in libraries):
                    continue
                for line in file["lines"]:
                    counts[path.relative_to(root)][line["line_number"]] += line["count"]
    return counts


def main():
    arguments = parse_arguments()
    run_tests(arguments.build, arguments.percent, arguments.jobs)
    counted = 0
    missed = []
    for path, lines in sorted(line_counts(arguments.build).items()):
        text = (root / path).read_text().split("\n")
        counted += len(lines)
        missed += [f"{path}:{number}: {text[number - 1].strip()}" for number, count in sorted(lines.items()) if count == 0]
    print("\n".join(missed))
    print(f"{counted - len(missed)} of {counted} lines run")
    sys.exit(1 if missed else 0)


main()
