#!/usr/bin/env python3
"""Breaks the library in named ways, one at a time, and shows that the suite catches each.

Each mutant of mutants.toml is one edit of a copy of the sources. What it changes is built again, and the tests that it
names run, on a fifth of the cases or as many as it says, until one fails. A mutant that none of them kills, or that
does not compile, has survived, unless it says why no test can kill it; survivors make the exit code 1.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib

root = pathlib.Path(__file__).resolve().parents[2]
# Most of the time goes into compiling, and one instruction set shows what a mutant does as well as six.
# What is broken may well leave something unused: -w.
flags = "-march=native -DHWY_COMPILE_ONLY_STATIC -w"
usual_percent = 20  # of the random cases
longest_test = 60  # seconds: some mutants never end


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=root / "build/mutation", help="where to copy and build")
    parser.add_argument("--only", metavar="PATTERN", help="mutants whose name this regular expression matches")
    parser.add_argument("--report", type=pathlib.Path, help="write the table to this file, mutant by mutant")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true", help="print the mutants' names and end")
    parser.add_argument("--check", action="store_true",
                        help="end once each edit has its place in the sources, and each mutant its row in README.md")
    return parser.parse_args()


def read_mutants(pattern):
    with open(root / "tests/mutation/mutants.toml", "rb") as file:
        mutants = tomllib.load(file)["mutant"]
    names = [mutant["name"] for mutant in mutants]
    if len(set(names)) != len(names):
        sys.exit("two mutants have the same name")
    return [mutant for mutant in mutants if pattern is None or re.search(pattern, mutant["name"])]


def mutated(mutant, text):
    """The text with the one edit, of which the place must be unmistakable."""
    count = text.count(mutant["before"])
    if count != 1:
        sys.exit(f"{mutant['name']}: {mutant['file']} has {count} places like\n{mutant['before']}")
    return text.replace(mutant["before"], mutant["after"])


def check_rows(mutants):
    """The table of README.md has one row for each mutant, with its file."""
    table = (root / "tests/mutation/README.md").read_text()
    for mutant in mutants:
        count = table.count(f"\n| {mutant['name']} | `{pathlib.Path(mutant['file']).name}` | ")
        if count != 1:
            sys.exit(f"{mutant['name']}: README.md has {count} rows")


class Copy:
    """A copy of the sources, built beside them."""

    def __init__(self, folder, jobs):
        self.source = folder / "source"
        self.binary = folder / "binary"
        self.jobs = jobs
        files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, capture_output=True,
                               text=True, check=True).stdout.split("\n")
        names = set(filter(None, files))
        for path in self.source.rglob("*"):  # What the sources no longer have.
            if path.is_file() and str(path.relative_to(self.source)) not in names:
                path.unlink()
        for name in sorted(names):
            target = self.source / name
            if target.exists() and target.read_bytes() == (root / name).read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(root / name, target)
            shutil.copymode(root / name, target)
        subprocess.run(["cmake", "-G", "Ninja", "-S", self.source, "-B", self.binary, "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1", f"-DCMAKE_CXX_FLAGS={flags}",
                        "-DSUREHIT_BUILD_BENCHMARKS=OFF"], check=True, stdout=subprocess.DEVNULL)

    def build(self, test):
        done = subprocess.run(["ninja", "-C", self.binary, "-j", str(self.jobs), test], capture_output=True, text=True)
        return done.returncode == 0, done.stdout

    def run(self, test, percent):
        """The first case that fails of a share of them; None if all pass."""
        program = next(self.binary.glob(f"**/{test}"))
        environment = dict(os.environ, SUREHIT_TEST_PERCENT=str(percent), GTEST_FAIL_FAST="1", GTEST_BRIEF="1")
        try:
            done = subprocess.run([program], cwd=self.binary, env=environment, capture_output=True, text=True,
                                  errors="replace", timeout=longest_test)
        except subprocess.TimeoutExpired:
            return f"{test}: does not end"
        if done.returncode == 0:
            return None
        failed = re.search(r"\[  FAILED  \] ([\w/]+\.[\w/]+)", done.stdout)
        return failed.group(1) if failed else f"{test}: ends with {done.returncode}"

    def killer(self, mutant):
        path = self.source / mutant["file"]
        good = path.read_text()
        path.write_text(mutated(mutant, good))
        try:
            for test in mutant["tests"]:
                built, output = self.build(test)
                if not built:
                    print(output[-3000:], file=sys.stderr)
                    return None
                if failed := self.run(test, mutant.get("percent", usual_percent)):
                    return failed
            return None
        finally:
            path.write_text(good)


def main():
    arguments = parse_arguments()
    mutants = read_mutants(arguments.only)
    if arguments.list:
        print("\n".join(mutant["name"] for mutant in mutants))
        return
    for mutant in mutants:
        mutated(mutant, (root / mutant["file"]).read_text())
    if arguments.check:
        check_rows(mutants)
        return
    copy = Copy(arguments.build.resolve(), arguments.jobs)
    for test in dict.fromkeys(test for mutant in mutants for test in mutant["tests"]):
        built, output = copy.build(test)
        if not built:
            sys.exit(f"{test} does not compile:\n{output[-3000:]}")
        if failed := copy.run(test, usual_percent):
            sys.exit(f"without any mutant {failed} fails")
    rows = ["| mutant | file | killed by |", "|---|---|---|"]
    survivors = 0
    for mutant in mutants:
        begin = time.monotonic()
        killer = copy.killer(mutant)
        if killer:
            verdict = f"`{killer}`"
            if "equivalent" in mutant:
                survivors += 1
                verdict += ", though it is called equivalent"
        elif "equivalent" in mutant:
            verdict = f"equivalent: {mutant['equivalent']}"
        else:
            survivors += 1
            verdict = "**survived**"
        rows.append(f"| {mutant['name']} | `{pathlib.Path(mutant['file']).name}` | {verdict} |")
        print(rows[-1], f"({time.monotonic() - begin:.0f} s)", flush=True)
        if arguments.report:
            arguments.report.write_text("\n".join(rows) + "\n")
    print(f"{len(mutants)} mutants, {survivors} survivors")
    sys.exit(1 if survivors else 0)


main()
