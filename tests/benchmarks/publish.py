#!/usr/bin/env python3
"""Measures everything and writes what is published: README.md between its markers, and figures/.

Each processor has a page in figures/, made from template.md, and a chart. The page ends with all tables of
surehit_benchmark.

It takes more than two hours, on a machine that does nothing else. With --keep, whatever ends it loses one run of the program
at most: the same command goes on from there.

What it does not know is passed on to surehit_benchmark. So is --quick, which shows in five minutes that all of this
works, and leaves figures without meaning: put the files back afterwards.
"""

import argparse
import csv
import datetime
import hashlib
import math
import re
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGES = HERE / "figures"
TEMPLATE = PAGES / "template.md"

PATH_SETS = ["short", "near", "long", "sight", "edge"]
ALL_SETS = ["short", "near", "detail", "long", "sight", "far", "far_rays", "edge", "edge_end", "cells", "in_plane"]
GENERAL_SETS = ALL_SETS[:7]
EVEN_MESHES = ["level", "dungeon", "nav_test", "ogre", "stanford-bunny"]
IN_DOUBLE = "surehit in double batch"
NOT_EDGE = PATH_SETS[:-1]
CLOSEST, ANY = "closest hit", "any hit"
OURS = ["surehit batch", "surehit single"]
INEXACT = ["surehit without its exact stage", "surehit without its filter"]
MEDIUM, LOW = "Embree fast medium", "Embree fast low"
ROBUST = "Embree robust medium"
OTHER_INSTRUCTION_SETS = ["avx2", "sse4"]
# The goals of each kind of path: a ratio of every mesh, and the geometric mean of all. Embree's time is over surehit's.
GOALS_OF_BATCHES = {
    "short": (1.3, 1.8), "near": (0.9, 1.2), "detail": (0.9, 1.2), "long": (0.85, 1.1), "sight": (0.85, 1.1),
    "far": (0.9, 1.2), "far_rays": (0.9, 1.2), "edge": (0.5, 0.7), "edge_end": (0.5, 0.7), "cells": (0.5, 0.7), "in_plane": (0.25, 0.4),
}  # fmt: skip
GOALS_OF_SINGLE_CALLS = {
    "short": (0.75, 0.9), "near": (0.75, 0.9), "detail": (0.75, 0.9), "long": (0.5, 0.6), "sight": (0.5, 0.6),
    "far": (0.75, 0.9), "far_rays": (0.75, 0.9),
}  # fmt: skip
# The same of builds, and of the memory that Embree takes over that of surehit.
GOALS_OF_BUILDS = {MEDIUM: (2.0, 3.0), LOW: (0.7, 0.9)}
GOALS_OF_MEMORY = {MEDIUM: (1 / 1.6, 1 / 1.3)}
BUILD_AND_MEMORY = [("build ns", "ms", "build", GOALS_OF_BUILDS), ("bytes", "MB", "bytes", GOALS_OF_MEMORY)]
# Here surehit's time in double is over that in float, so more is worse.
GOALS_OF_DOUBLES = {"short": (2.0, 2.0), "near": (2.0, 2.0), "long": (2.0, 2.0)}
# The tables of a few even meshes with all contenders, and the queries and builds of all meshes.
TABLES, CONTENT = "tables", "content"
# Moving shapes take the peers so long that one mesh and a third of the rounds have to do.
TABLES_OF_PATHS = ["queries", "build", "load", "size", "tick", "threads", "exactness", "statistics", "scene"]
SHAPES = ["--table", "shapes", "--mesh", "dungeon"]
SCENES_OF_SHAPES = ["town", "forest", "bricks", "one"]


def fail(reason):
    sys.exit(f"publish.py: {reason}")


def processor():
    cpuinfo = Path("/proc/cpuinfo").read_text(encoding="utf-8")

    def told(field):
        values = re.findall(rf"^{field}\s*:\s*(.*)$", cpuinfo, re.MULTILINE)
        return values[:1]  # not all processors tell all fields

    names = [" ".join(re.sub(r"\((R|TM)\)|@.*$", "", name).split()) for name in told("model name")]
    # Virtual machines often tell a processor's brand alone, which generations share.
    generation = [f"family {family}" for family in told("cpu family")] + [f"model {model}" for model in told("model")]
    return ", ".join((names or ["unknown processor"]) + generation)


class KeptRuns:
    """A folder with what each run of the program has measured and printed. A run that is there is not made again."""

    def __init__(self, folder, program):
        self.folder = folder
        self.program = program
        self.count = 0
        folder.mkdir(parents=True, exist_ok=True)
        of_program = folder / "program"
        digest = hashlib.sha256(program.read_bytes()).hexdigest() + f" on {processor()}\n"
        if not of_program.exists():
            of_program.write_text(digest, encoding="utf-8")
        elif of_program.read_text(encoding="utf-8") != digest:
            fail(f"{folder} has figures of another program or processor")

    def make(self, options, files):
        """Returns the paths of the CSV file and of what was printed. `files` are options that name files to write."""
        stem = self.folder / f"{self.count:02}"
        self.count += 1
        command, printed, table = (stem.with_suffix(ending) for ending in (".command", ".txt", ".csv"))
        shown = shlex.join(map(str, [*options, *files])) + "\n"
        if command.exists():
            if command.read_text(encoding="utf-8") != shown:
                fail(f"{command} is of another command; empty {self.folder}, or ask as before")
            return table, printed
        with printed.open("w", encoding="utf-8") as output:
            subprocess.run([self.program, *options, *files, "--csv", table], check=True, stdout=output)
        command.write_text(shown, encoding="utf-8")
        return table, printed


class Figures:
    """All rows of the program's CSV files, in the order in which they were measured."""

    def __init__(self, rounds):
        self.rows = []
        self.rounds = rounds
        self.days = []

    def add(self, path, run):
        self.days.append(datetime.date.fromtimestamp(path.stat().st_mtime))
        with open(path, newline="", encoding="utf-8") as file:
            self.rows += [{"run": run, **row} for row in csv.DictReader(file)]

    @property
    def instruction_sets(self):
        return self.values("instruction_set")

    def matching(self, **where):
        return [row for row in self.rows if all(row[column] == value for column, value in where.items())]

    def values(self, column, **where):
        return list(dict.fromkeys(row[column] for row in self.matching(**where)))

    def median(self, **where):
        """The median of the one row that is meant; on the machine's best instruction set unless it is said which."""
        rows = self.matching(**{"run": TABLES, "instruction_set": self.instruction_sets[0], **where})
        if len(rows) != 1:
            fail(f"{len(rows)} figures instead of one for {where}")
        return float(rows[0]["median"])

    def meshes(self, table, run=TABLES):
        """Each mesh's name in the CSV, and with its triangles as it is shown."""
        for mesh in self.values("mesh", table=table, run=run):
            triangles = int(self.values("triangles", table=table, mesh=mesh, run=run)[0])
            yield mesh, f"{'built-in level' if mesh == 'level' else mesh} ({triangles:,})"


def number(value):
    return f"{value:.{2 if abs(value) < 10 else 1 if abs(value) < 100 else 0}f}"


def beside_goal(ratio, goal, worst=min):
    """The ratio, in bold type if it misses its goal."""
    misses = goal is not None and worst(ratio, goal) != goal
    return f"**{number(ratio)}**" if misses else number(ratio)


def markdown(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def name_of_instruction_set(name):
    return name.upper().replace("AVX512", "AVX-512")


# What is between the markers: a function for each block, by its name.


def machine(figures):
    return f"{processor()}, {name_of_instruction_set(figures.instruction_sets[0])}"


def page_name(figures):
    """What the files of this processor are named after."""
    return re.sub(r"\W+", "_", machine(figures)).strip("_").lower()


def chart(figures):
    return f"![How many times as long Embree takes, from the worst mesh to the best]({page_name(figures)}.svg)\n"


def run_of(figures):
    """When the figures were measured, of which sources, and how often."""
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], check=True, stdout=subprocess.PIPE,
                            encoding="utf-8").stdout.strip()  # fmt: skip
    first, last = min(figures.days), max(figures.days)
    day = str(first) if first == last else f"{first} to {last}"
    return f"{day}, commit {commit}, medians of {figures.rounds} rounds"


def queries(figures):
    rows = []
    for mesh, shown in figures.meshes("queries"):
        for paths in PATH_SETS:

            def median(question, contender, measure):
                return figures.median(
                    table="queries", mesh=mesh, paths=paths, question=question, contender=contender, measure=measure
                )

            cells = [shown, paths]
            for question in CLOSEST, ANY:
                cells.append(number(median(question, "surehit batch", "ns per path")) + " ns")
                cells += [number(median(question, f"{MEDIUM} {way}", "over surehit batch")) for way in ("x1", "x8")]
            singles = [number(median(question, f"{MEDIUM} x1", "over surehit single")) for question in (CLOSEST, ANY)]
            wrong = median(ANY, f"{MEDIUM} x1", "wrong decisions")
            rows.append([*cells, " / ".join(singles), f"{wrong:.0f}"])
    return markdown(
        ["mesh (triangles)", "paths", "closest: batch", "÷ single rays", "÷ packets", "any: batch", "÷ single rays"]
        + ["÷ packets", "single calls, closest / any", "wrong"],
        rows,
    )


def shown_range(ratios, show=number):
    return f"{show(min(ratios))} to {show(max(ratios))}"


def query_ratios(figures, questions, contender, ours, sets):
    return [
        figures.median(
            table="queries", mesh=mesh, paths=paths, question=question, contender=contender, measure=f"over {ours}"
        )
        for mesh in figures.values("mesh", table="queries", run=TABLES)
        for paths in sets
        for question in questions
    ]


def ranges(figures):
    batch, single = OURS
    rows = [
        [
            asked,
            *(
                shown_range(query_ratios(figures, [question], f"{MEDIUM} {way}", ours, NOT_EDGE))
                for question in (CLOSEST, ANY)
            ),
        ]
        for asked, ours, way in (
            ("batch ÷ single rays", batch, "x1"),
            ("batch ÷ packets", batch, "x8"),
            ("single calls ÷ single rays", single, "x1"),
        )
    ]
    return markdown(["min to max", "closest hit", "any hit"], rows)


def wrong(figures):
    """The wrong decisions of the same peers, and the time."""
    rows = []
    for shown, contender in (
        ("surehit, batches", OURS[0]),
        ("CGAL, exact predicates", "CGAL"),
        ("Embree, robust mode", f"{ROBUST} x1"),
        ("Embree, fast mode", f"{MEDIUM} x1"),
        ("Bullet", "Bullet"),
    ):
        row = [shown]
        for sets in ["edge"], NOT_EDGE:
            counts = [
                figures.median(
                    table="queries", mesh=mesh, paths=paths, question=ANY, contender=contender,
                    measure="wrong decisions",
                )
                for mesh in figures.values("mesh", table="queries", run=TABLES)
                for paths in sets
            ]  # fmt: skip
            row.append(f"{sum(counts):,.0f}")
        if contender == OURS[0]:
            row.append("1")
        else:
            row.append(shown_range(query_ratios(figures, [ANY], contender, OURS[0], PATH_SETS)))
        rows.append(row)
    times = f"time, relative to surehit ({machine(figures)})"
    return markdown(["", "aimed at vertices and edges", "all others", times], rows)


def summary(figures):
    batch, single = OURS

    def over(sets, ours, **where):
        """The ratios of all meshes, each with its mesh and kind of path."""
        return [
            (figures.median(run=CONTENT, table="queries", mesh=mesh, paths=paths, question=question,
                            contender=f"{MEDIUM} x1", measure=f"over {ours}", **where), mesh, paths)
            for mesh in figures.values("mesh", table="queries", run=CONTENT)
            for paths in sets
            for question in (CLOSEST, ANY)
        ]  # fmt: skip

    def told(ratios):
        worst, mesh, paths = min(ratios)
        mean = geometric_mean([ratio for ratio, _, _ in ratios])
        return f"{number(mean)} times as fast as single rays on average. The worst is {number(worst)} ({paths} in {mesh})"

    def builds_over(quality, measure):
        meshes = figures.values("mesh", table="build", run=CONTENT)
        return [figures.median(run=CONTENT, table="build", mesh=mesh, contender=quality, measure=measure)
                for mesh in meshes]  # fmt: skip

    meshes = len(figures.values("mesh", table="queries", run=CONTENT))
    degenerate = [paths for paths in ALL_SETS if paths not in GENERAL_SETS]
    builds_in_medium, builds_in_low = (builds_over(quality, "build over surehit") for quality in (MEDIUM, LOW))
    memory = [1 / ratio for ratio in builds_over(MEDIUM, "bytes over surehit")]
    lines = [
        f"{meshes} meshes, paths in general position: batches are {told(over(GENERAL_SETS, batch))}. "
        f"Single calls are {told(over(GENERAL_SETS, single))}.",
        f"Paths along edges, to vertices, between centres of cubes and in planes: batches are "
        f"{told(over(degenerate, batch))}.",
        f"A build is {number(geometric_mean(builds_in_medium))} times as fast as one of Embree's medium quality on "
        f"average, and {number(geometric_mean(builds_in_low))} times as one of low quality. It takes "
        f"{number(geometric_mean(memory))} times the memory of medium quality.",
    ]
    if "avx2" in figures.instruction_sets[1:]:
        lines.append(
            f"With AVX2 alone, while Embree keeps its best, batches are "
            f"{told(over(GENERAL_SETS, batch, instruction_set='avx2'))}."
        )
    return "".join(f"- {line}\n" for line in lines)


def geometric_mean(ratios):
    return math.exp(statistics.fmean(map(math.log, ratios)))


def all_meshes(figures, contender, measure, goals, worst=min, **where):
    """A row for each mesh, a column for each kind of path: closest / any. The worst and the mean are the last rows."""

    def ratio(mesh, paths, question):
        return figures.median(
            run=CONTENT, table="queries", mesh=mesh, paths=paths, question=question, contender=contender,
            measure=measure, **where,
        )  # fmt: skip

    meshes = list(figures.meshes("queries", CONTENT))
    by_cell = {
        (paths, question): [ratio(mesh, paths, question) for mesh, _ in meshes]
        for paths in ALL_SETS
        for question in (CLOSEST, ANY)
    }

    def row(shown, of, goal_of=lambda goals: goals[0]):
        return [shown, *(" / ".join(beside_goal(of(by_cell[paths, question]),
                                                goal_of(goals[paths]) if paths in goals else None, worst)
                                    for question in (CLOSEST, ANY))
                         for paths in ALL_SETS)]  # fmt: skip

    rows = [row(shown, lambda ratios, i=i: ratios[i]) for i, (_, shown) in enumerate(meshes)]
    rows += [row("worst", worst), row("mean", geometric_mean, lambda goals: goals[1])]
    return markdown(["mesh (triangles)", *ALL_SETS], rows)


def all_batches(figures):
    return all_meshes(figures, f"{MEDIUM} x1", "over surehit batch", GOALS_OF_BATCHES)


def all_batches_on_avx2(figures):
    if "avx2" not in figures.instruction_sets[1:]:
        return ""
    return all_meshes(figures, f"{MEDIUM} x1", "over surehit batch", GOALS_OF_BATCHES, instruction_set="avx2")


def all_single_calls(figures):
    return all_meshes(figures, f"{MEDIUM} x1", "over surehit single", GOALS_OF_SINGLE_CALLS)


def all_doubles(figures):
    return all_meshes(figures, IN_DOUBLE, "over surehit batch", GOALS_OF_DOUBLES, worst=max)


def builds(figures, run=TABLES):
    """A row for each mesh. The mean is the last row."""
    rows = []
    ratios = {}
    for mesh, shown in figures.meshes("build", run):

        def median(contender, measure):
            return figures.median(run=run, table="build", mesh=mesh, contender=contender, measure=measure)

        cells = [shown]
        for measure, unit, of_ours, goals in BUILD_AND_MEMORY:
            cells.append(f"{number(median('surehit', measure) / 1e6)} {unit}")
            for quality in (MEDIUM, LOW):
                ratio = median(quality, f"{of_ours} over surehit")
                ratios.setdefault((of_ours, quality), []).append(ratio)
                cells.append(beside_goal(ratio, goals.get(quality, (None, None))[0]))
        rows.append(cells)
    row_of_means = ["mean"]
    for _, _, of_ours, goals in BUILD_AND_MEMORY:
        row_of_means.append("")
        row_of_means += [beside_goal(geometric_mean(ratios[of_ours, quality]), goals.get(quality, (None, None))[1])
                         for quality in (MEDIUM, LOW)]  # fmt: skip
    rows.append(row_of_means)
    return markdown(["mesh (triangles)", "build", "÷ medium", "÷ low", "memory", "÷ medium", "÷ low"], rows)


def all_builds(figures):
    return builds(figures, CONTENT)


def ticks(figures):
    counts = figures.values("paths", table="tick")
    rows = []
    for mesh, shown in figures.meshes("tick"):
        cells = [shown]
        for count in counts:

            def median(contender, measure):
                return figures.median(table="tick", mesh=mesh, paths=count, contender=contender, measure=measure)

            times = [median("surehit batch", measure) / 1e6 for measure in ("tick ns", "rebuild ns")]
            cells.append(f"{number(times[0])} ms ({number(times[1])} ms)")
            cells += [number(median(f"{LOW} {way}", "over surehit batch")) for way in ("x1", "x8")]
        rows.append(cells)
    header = ["mesh (triangles)"]
    for count in counts:
        header += [f"{int(count.split()[0]):,} paths (of it rebuild)", "÷ single rays", "÷ packets"]
    return markdown(header, rows)


def scenes(figures):
    rows = []
    for scene in figures.values("mesh", table="scene", run=TABLES):
        for paths in figures.values("paths", table="scene", mesh=scene, run=TABLES):
            if not paths:
                continue  # those are commits

            def median(question, contender, measure):
                return figures.median(
                    table="scene", mesh=scene, paths=paths, question=question, contender=contender, measure=measure
                )

            cells = [scene, paths]
            for question in CLOSEST, ANY:
                cells.append(number(median(question, OURS[0], "ns per path")) + " ns")
                cells += [number(median(question, f"{MEDIUM} x1", f"over {ours}")) for ours in OURS]
            wrong_counts = [median(ANY, f"{mode} x1", "wrong decisions") for mode in (MEDIUM, ROBUST)]
            rows.append([*cells, " / ".join(f"{count:.0f}" for count in wrong_counts)])
    return markdown(
        ["scene", "paths", "closest: batch", "÷ batch", "÷ single calls", "any: batch", "÷ batch", "÷ single calls"]
        + ["wrong, fast / robust"],
        rows,
    )


def commits(figures):
    rows = []
    for scene in figures.values("mesh", table="scene", measure="commit ns", run=TABLES):

        def median(contender, measure):
            return figures.median(table="scene", mesh=scene, contender=contender, measure=measure)

        cells = [scene]
        for change in "commit", "commit of a tenth", "exchange":
            cells += [f"{number(median('surehit', change + ' ns') / 1e6)} ms", number(median(LOW, change + " over surehit"))]
        rows.append(cells)
    return markdown(
        ["scene", "all move", "÷ low", "a tenth moves", "÷ low", "one goes and one comes", "÷ low"],
        rows,
    )


def scene_shapes(figures):
    """The ratios of moving shapes in scenes, from the lowest to the highest of all kinds of paths."""
    batch, single = OURS
    rows = []
    for scene in figures.values("mesh", table="scene_shapes", run=TABLES):
        for shape in figures.values("question", table="scene_shapes", mesh=scene, run=TABLES):
            here = {"table": "scene_shapes", "mesh": scene, "question": shape}

            def all_of(contender, measure):
                return shown_range(
                    [
                        figures.median(**here, paths=paths, contender=contender, measure=measure)
                        for paths in figures.values("paths", **here, run=TABLES)
                    ]
                )

            rows.append(
                [
                    scene,
                    shape,
                    all_of("Bullet", f"over {single}"),
                    all_of(single, "over surehit segment single"),
                    all_of(batch, "over surehit segment batch"),
                    all_of(batch, f"over {single}"),
                ]
            )
    columns = ["Bullet over single calls", "single calls over points", "batches over points", "batches over single calls"]
    return markdown(["scene", "shape", *columns], rows)


def growth(figures):
    exponent = "growth exponent of "
    rows = []
    for mesh in figures.values("mesh", table="size", measure=exponent + "ns"):
        sizes = [int(size) for size in figures.values("triangles", table="size", mesh=mesh) if size != "0"]

        def both(ours, theirs, paths, measure):
            medians = [
                figures.median(table="size", mesh=mesh, contender=who, paths=paths, measure=exponent + measure)
                for who in (ours, theirs)
            ]
            return " / ".join(map(number, medians))

        cells = [mesh, f"{min(sizes):,} to {max(sizes):,}"]
        cells += [both("surehit", MEDIUM, "", measure) for measure in ("build ms", "MB")]
        cells += [both("surehit batch", f"{MEDIUM} x1", paths, "ns") for paths in ("short", "near", "long")]
        rows.append(cells)
    return markdown(["mesh", "triangles", "build", "memory", "short", "near", "long"], rows)


def over_meshes(figures, **where):
    """The median of what is the median of each mesh."""
    meshes = figures.values("mesh", table=where["table"], run=TABLES)
    return number(statistics.median(figures.median(mesh=mesh, **where) for mesh in meshes))


def threads(figures):
    rows = []
    for paths in PATH_SETS:

        def median(contender, measure):
            return over_meshes(figures, table="threads", paths=paths, contender=contender, measure=measure)

        them = f"{MEDIUM} x1"
        cells = [median("surehit batch", "speedup"), median(them, "speedup")]
        rows.append([paths, *cells, median(them, "over surehit batch on 2 threads")])
    return markdown(["paths", "speedup of surehit", "of Embree", "÷ on two threads"], rows)


def instruction_sets(figures):
    def cell(name, paths):
        ratios = [
            over_meshes(
                figures, instruction_set=name, table="queries", paths=paths, question=question,
                contender=f"{MEDIUM} x1", measure="over surehit batch",
            )
            for question in (CLOSEST, ANY)
        ]  # fmt: skip
        return " / ".join(ratios)

    names = figures.instruction_sets
    rows = [[paths, *(cell(name, paths) for name in names)] for paths in PATH_SETS]
    return markdown(["paths", *map(name_of_instruction_set, names)], rows)


def exactness(figures):
    meshes = figures.values("mesh", table="exactness")
    rows = []
    for paths in PATH_SETS:
        here = {"table": "exactness", "paths": paths}
        row = [paths]
        for contender in INEXACT:
            for question in (CLOSEST, ANY):
                cost = over_meshes(
                    figures, **here, question=question, contender=contender, measure="cost of exactness in %"
                )
                row.append(f"{cost}%")
            wrong = sum(
                figures.median(**here, mesh=mesh, contender=contender, measure="wrong decisions") for mesh in meshes
            )
            row.append(f"{wrong:.0f}")
        rows.append(row)
    columns = ["over no exact stage: closest hit", "any hit", "wrong", "over no filter: closest hit", "any hit", "wrong"]
    return markdown(["paths", *columns], rows)


def bounds(figures):
    rows = []
    for paths in PATH_SETS:
        here = {"table": "statistics", "paths": paths, "contender": OURS[0]}
        counts = [
            over_meshes(figures, **here, question=ANY, measure=measure)
            for measure in ("cells per path", "candidates per path")
        ]
        shares = [
            over_meshes(figures, **here, question=question, measure="share of these alone in %")
            for question in (CLOSEST, ANY)
        ]
        rows.append([paths, *counts, *(f"{share}%" for share in shares)])
    return markdown(["paths", "cells", "candidates", "closest hit", "any hit"], rows)


def pages(_):
    """The list of all pages."""
    texts = {page.name: page.read_text(encoding="utf-8") for page in sorted(PAGES.glob("*.md")) if page != TEMPLATE}
    machines = {name: re.search(r"<!-- figures: machine -->(.*?)<!--", text)[1] for name, text in texts.items()}
    return "".join(f"- [{machine}](figures/{name})\n" for name, machine in machines.items())


def summaries(_):
    """The summaries of all pages, each below its machine, with the day and the commit of its run."""
    texts = []
    for page in sorted(PAGES.glob("*.md")):
        blocks = {match[2]: match[0] for match in MARKED.finditer(page.read_text(encoding="utf-8"))}
        if page.name != TEMPLATE.name:
            inner = {name: re.sub(r"<!--.*?-->", "", text).strip() for name, text in blocks.items()}
            day, commit = inner["run_of"].split(", ")[:2]
            texts.append(f"{inner['machine']}, {day}, {commit}:\n\n{inner['summary']}\n")
    return "\n".join(texts)


BLOCKS_OF_README = [wrong, summaries]
BLOCKS_OF_FIGURES = [
    machine, run_of, summary, chart, all_batches, all_batches_on_avx2, all_single_calls, all_doubles, all_builds, queries,
    ranges, instruction_sets, builds, ticks, scenes, commits, scene_shapes, growth, threads, exactness, bounds,
]  # fmt: skip
BLOCKS = {block.__name__: block for block in [*BLOCKS_OF_README, *BLOCKS_OF_FIGURES, pages]}


MARKED = re.compile(r"(<!-- figures: (\w+) -->)(\n?).*?(<!-- end -->)", re.DOTALL)
ALL_TABLES = "<!-- figures: all tables -->\n"


def with_blocks(text, figures):
    """The text with anew what stands between markers: whole lines or a part of one, as it was before."""

    def renewed(match):
        around = "\n" if match[3] else ""
        return match[1] + around * 2 + BLOCKS[match[2]](figures) + around + match[4]

    return MARKED.sub(renewed, text)


def read_published(path, blocks):
    """The text, if it has the markers of these blocks. This is found out before the minutes of measuring."""
    text = path.read_text(encoding="utf-8")
    names = sorted(match[2] for match in MARKED.finditer(text))
    expected = sorted(block.__name__ for block in blocks)
    if names != expected:
        fail(f"{path.name} has blocks {names} instead of {expected}")
    return text


def check(figures):
    contenders = figures.values("contender")
    if not {"CGAL", "Bullet", f"{MEDIUM} x1", f"{ROBUST} x1"} <= set(contenders):
        fail("README.md compares with Embree, CGAL and Bullet; the benchmark was built or run without one of them")
    for row in figures.matching(measure="wrong decisions"):
        if row["contender"] in [*OURS, IN_DOUBLE] and float(row["median"]) > 0:
            fail(f"surehit is wrong, which has to be mended first: {row}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     allow_abbrev=False)  # fmt: skip
    parser.add_argument("meshes", metavar="FOLDER", help="every mesh in it is measured, besides the built-in level")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", metavar="FOLDER",
                        help="where CMake was configured, in Release (default: build/release)")  # fmt: skip
    parser.add_argument("--z-up", action="append", default=[], metavar="NAME",
                        help="a mesh of the folder whose upward axis is z")  # fmt: skip
    parser.add_argument("--rounds", default=9, type=int, metavar="COUNT",
                        help="how often each contender is measured (default: 9)")  # fmt: skip
    parser.add_argument("--keep", type=Path, metavar="FOLDER",
                        help="keeps what was measured in a folder, and does not measure what is there")  # fmt: skip
    arguments, passed_on = parser.parse_known_args()
    if not (arguments.build / "CMakeCache.txt").exists():
        fail(f"{arguments.build} is not configured; cmake --preset release does it for build/release")
    subprocess.run(["cmake", "--build", arguments.build, "--target", "surehit_benchmark"], check=True)
    readme = ROOT / "README.md"
    text_of_readme = read_published(readme, BLOCKS_OF_README)
    full = HERE / "FIGURES.md"
    text_of_full = read_published(full, [pages])
    text_of_page = read_published(TEMPLATE, BLOCKS_OF_FIGURES)
    if text_of_page.count(ALL_TABLES) != 1:
        fail(f"{TEMPLATE.name} lacks the line {ALL_TABLES.strip()}")
    program = arguments.build / "tests" / "benchmarks" / "surehit_benchmark"

    figures = Figures(arguments.rounds)
    sections = []
    with tempfile.TemporaryDirectory() as folder:
        runs = KeptRuns(arguments.keep or Path(folder), program)
        chart_path = runs.folder / "chart.svg"

        def run(kind, *options, rounds=arguments.rounds, files=()):
            options = [*z_up, *options, *passed_on, "--rounds", str(rounds)]
            shown = shlex.join(["surehit_benchmark", "--meshes", "FOLDER", *options])
            print(shown, file=sys.stderr)
            table, printed = runs.make(["--meshes", arguments.meshes, *options], files)
            figures.add(table, kind)
            sections.append(f"    {shown}\n\n{printed.read_text(encoding='utf-8').rstrip()}")

        z_up = [option for mesh in arguments.z_up for option in ("--z-up", mesh)]
        meshes = [option for mesh in EVEN_MESHES for option in ("--mesh", mesh)]
        sets = [option for paths in PATH_SETS for option in ("--set", paths)]
        for table in TABLES_OF_PATHS:
            run(TABLES, *meshes, *sets, "--table", table)
        others = [name for name in OTHER_INSTRUCTION_SETS if name != figures.instruction_sets[0]]
        for name in others:
            run(TABLES, *meshes, *sets, "--instruction-set", name, "--table", "queries", "--contender", MEDIUM)
        content = ["--uneven", "--table", "queries", "--contender", MEDIUM, "--contender", IN_DOUBLE, "--paths", "5000"]
        run(CONTENT, *content, files=["--chart", chart_path, "--machine", machine(figures)])
        if "avx2" in others:
            run(CONTENT, *content, "--instruction-set", "avx2")
        run(CONTENT, "--uneven", "--table", "build")
        paths_of_shapes = [] if "--quick" in passed_on else ["--paths", "2000"]
        run(TABLES, *SHAPES, *paths_of_shapes, rounds=math.ceil(arguments.rounds / 3))
        worlds = [option for scene in SCENES_OF_SHAPES for option in ("--scene", scene)]
        paths_of_shapes = [] if "--quick" in passed_on else ["--paths", "500"]
        run(TABLES, "--table", "scene_shapes", *worlds, *paths_of_shapes, rounds=math.ceil(arguments.rounds / 3))

        check(figures)
        name = page_name(figures)
        head = text_of_page.partition(ALL_TABLES)[0]
        shown = "".join(f"\n{section}\n" for section in sections)
        (PAGES / f"{name}.md").write_text(with_blocks(head, figures) + ALL_TABLES + shown, encoding="utf-8")
        full.write_text(with_blocks(text_of_full, figures), encoding="utf-8")
        readme.write_text(with_blocks(text_of_readme, figures), encoding="utf-8")
        shutil.copyfile(chart_path, PAGES / f"{name}.svg")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
