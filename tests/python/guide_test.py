"""The code of the package's README runs, prints what the page says, and makes the pictures that the page shows.

With SUREHIT_PICTURE_FOLDER, the pictures are kept in this folder, to be looked at and shown.
"""

import contextlib
import io
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.image
except ImportError:
    matplotlib = None

GUIDE = Path(os.environ["SUREHIT_SOURCE_FOLDER"]) / "collision/bindings/python/README.md"


def blocks_of(text):
    """Returns the language and the text of each code block, and the number of its first line."""
    found = re.finditer(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [(match[1], match[2], text.count("\n", 0, match.start()) + 2) for match in found]


def differing_share(picture, shown):
    """Returns the share of points whose colours differ clearly. Fonts may be a little different elsewhere."""
    return np.mean(np.abs(picture[..., :3] - shown[..., :3]).max(axis=-1) > 0.1)


@unittest.skipIf(matplotlib is None, "Matplotlib is not installed")
class GuideTest(unittest.TestCase):
    def test_the_page(self):
        text = GUIDE.read_text()
        names = {"__name__": "guide"}
        printed = ""
        pictures = re.findall(r"!\[[^\]]*\]\((\w+\.png)\)", text)
        kept = os.environ.get("SUREHIT_PICTURE_FOLDER")
        with tempfile.TemporaryDirectory() as folder:
            self.addCleanup(os.chdir, os.getcwd())
            os.chdir(kept or folder)
            for language, block, line in blocks_of(text):
                self.assertIn(language, ("python", "text", "sh"))
                if language == "text":
                    self.assertEqual(printed, block, f"{GUIDE.name}:{line}")
                elif language == "python":
                    output = io.StringIO()
                    with contextlib.redirect_stdout(output):
                        exec(compile("\n" * (line - 1) + block, str(GUIDE), "exec"), names)
                    printed = output.getvalue()
            self.assertEqual(sorted(pictures), sorted(path.name for path in Path().glob("*.png")))
            for name in pictures:
                with self.subTest(picture=name):
                    made, shown = matplotlib.image.imread(name), matplotlib.image.imread(GUIDE.parent / name)
                    self.assertEqual(made.shape[:2], shown.shape[:2])
                    self.assertLess(differing_share(made, shown), 0.01)
        self.assertGreater(np.count_nonzero(names["missed"]["textbook"]), 50)
        self.assertEqual(np.count_nonzero(names["missed"]["surehit"]), 0)


if __name__ == "__main__":
    sys.exit(unittest.main())
