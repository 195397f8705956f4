"""The examples of the Python module run, and what they write holds what it says.

    examples_test.py PROGRAM
"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

from find_module import REPOSITORY

EXAMPLES = REPOSITORY / "python/examples"
RUNS = {
    "error_against_time.py": ["spheres", "figure.svg", "1", "48x27"],
    "light_counts.py": ["lattice", "table.csv", "8", "32"],
}


class Examples(unittest.TestCase):
    def run_(self, name):
        """Runs it in a folder of its own, which is returned."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        result = subprocess.run([sys.executable, "-B", EXAMPLES / name, *RUNS[name]], cwd=folder.name, capture_output=True,
                                text=True, timeout=900)
        self.assertEqual(result.returncode, 0, result.stderr)
        return pathlib.Path(folder.name)

    def testTheFigureHasAPointOfEachTechniqueAndLayout(self):
        figure = xml.dom.minidom.parse(str(self.run_("error_against_time.py") / "figure.svg"))
        titles = [title.firstChild.data for title in figure.getElementsByTagName("title")]
        for word in ("forward,", "clustered_deferred,", "exact:", "packed:", "slim:"):
            self.assertTrue(any(word in title for title in titles), (word, titles))
        for circle in figure.getElementsByTagName("circle"):
            self.assertTrue(0 < float(circle.getAttribute("cx")) < 720 and 0 < float(circle.getAttribute("cy")) < 440)

    def testTheTableHasARowOfEachCount(self):
        with open(self.run_("light_counts.py") / "table.csv", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        self.assertEqual([row[0] for row in rows], ["8", "32"])
        self.assertTrue(all(float(cell) > 0 for row in rows for cell in row), rows)
        self.assertEqual(len(head), len(rows[0]))

    def testEveryExampleIsRun(self):
        self.assertEqual({path.name for path in EXAMPLES.glob("*.py")}, set(RUNS))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
