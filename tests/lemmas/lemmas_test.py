"""Checks the numbered lemmas: each is defined once, and each that is cited is defined.

A definition begins a heading of a page (`## L1. Error of a crossing`) or a line of a comment (`/// K1. Let ...`). Tests
only cite lemmas.
"""

import collections
import pathlib
import re
import sys

LEMMA = r"[A-Z]{1,2}[1-9]\d?"
DEFINITION = re.compile(rf"^(?:#+|\s*///?) ({LEMMA})\. ", re.MULTILINE)
NAME = re.compile(rf"(?<![\w/-]){LEMMA}(?!\w)")  # Neither -O2 nor /W4.
# The edges of a triangle, a language, and what begins a picture.
NO_LEMMAS = {"E1", "E2", "C99", "P6"}
SUFFIXES = {".md", ".hpp", ".cpp", ".h", ".glsl", ".comp", ".toml"}
BUILT = re.compile("node_modules/|^collision/bindings/python/build/")


def faults_of(texts):
    """Returns a line for each fault, and the number of lemmas. `texts` has the text of each path."""
    places = collections.defaultdict(list)
    for path, text in texts.items():
        if not path.startswith("tests/"):
            for lemma in DEFINITION.findall(text):
                places[lemma].append(path)
    faults = [f"{lemma} is defined in {' and in '.join(paths)}" for lemma, paths in places.items() if len(paths) > 1]
    for path, text in texts.items():
        for lemma in sorted(set(NAME.findall(text)) - places.keys() - NO_LEMMAS):
            faults.append(f"{path} cites {lemma}, which is not defined")
    return faults, len(places)


def main():
    # Both faults are found.
    assert faults_of({"a.md": "# A1. Sums\n", "b.hpp": "  /// A1. Sums\n", "c.cpp": "f();  // A1, B2\n"})[0] == [
        "A1 is defined in a.md and in b.hpp", "c.cpp cites B2, which is not defined"]

    root = pathlib.Path(sys.argv[1])
    paths = list(root.glob("*.md"))
    for folder in ("broadphase", "collision", "examples", "tests"):
        paths += (root / folder).rglob("*")
    names = sorted(path.relative_to(root).as_posix() for path in paths if path.suffix in SUFFIXES)
    texts = {name: (root / name).read_text(encoding="utf-8") for name in names if not BUILT.search(name)}
    faults, count = faults_of(texts)
    print("\n".join(faults))
    print(f"{count} lemmas, {len(faults)} faults")
    return 1 if faults or count < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
