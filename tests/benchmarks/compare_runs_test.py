"""What is slower is told, and nothing else."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parent / "compare_runs.py"
HEADER = "instruction_set,table,mesh,triangles,paths,question,contender,measure,median,min,max\n"


class CompareRunsTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, **times):
        """A file with the least time of each contender."""
        path = Path(self.folder.name) / name
        rows = [f"avx2,queries,level,9,long,any hit,{contender.replace('_', ' ')},ns per path,900,{least},999\n"
                for contender, least in times.items()]  # fmt: skip
        path.write_text(HEADER + "".join(rows) + "avx2,queries,level,9,long,any hit,surehit batch,wrong decisions,9,9,9\n")
        return path

    def compare(self, before, after, *options):
        done = subprocess.run([sys.executable, PROGRAM, "--before", *before, "--after", *after, *options],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")  # fmt: skip
        return done.returncode, done.stdout, done.stderr

    def test_what_is_slower_is_told(self):
        before = [self.write("before.1", surehit_batch=100, surehit_single=130, Embree=50),
                  self.write("before.2", surehit_batch=120, surehit_single=120, Embree=50)]  # fmt: skip
        after = [self.write("after.1", surehit_batch=125, surehit_single=110, Embree=90),
                 self.write("after.2", surehit_batch=130, surehit_single=140, Embree=90)]  # fmt: skip
        status, told, _ = self.compare(before, after)
        self.assertEqual(status, 1)
        self.assertEqual(told, "0.800  avx2, queries, level, long, any hit, surehit batch, ns per path\n"
                               "1 of 2 figures are below 0.98; their mean is 0.934\n")  # fmt: skip
        status, told, _ = self.compare(before, after, "--least", "0.75")
        self.assertEqual((status, told), (0, "0 of 2 figures are below 0.75; their mean is 0.934\n"))

    def test_runs_of_other_figures_are_refused(self):
        batch, single, peer = (self.write(name, **{name: 1}) for name in ("surehit_batch", "surehit_single", "Embree"))
        status, told, error = self.compare([batch], [single])
        self.assertEqual((status, told), (1, ""))
        self.assertIn("not in both runs: avx2 queries level long any hit surehit batch ns per path", error)
        self.assertIn("not in both runs: any time", self.compare([peer], [batch])[2])


if __name__ == "__main__":
    unittest.main()
