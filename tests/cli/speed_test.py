"""tools/speed reads its arguments, alternates its two programs and reports what they took."""

import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

SPEED = pathlib.Path(__file__).resolve().parents[2] / "tools" / "speed"
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("speed", str(SPEED))
speed = importlib.util.module_from_spec(importlib.util.spec_from_loader("speed", loader))
loader.exec_module(speed)


class Speed(unittest.TestCase):
    def testOneCommitIsComparedWithHead(self):
        self.assertEqual(speed.optionsIn(["abc"]), (["abc", "HEAD"], 9, list(speed.VIEWS), False))
        self.assertEqual(speed.optionsIn(["a", "--rounds", "3", "b", "--views", "hall,head", "--remove"]),
                         (["a", "b"], 3, ["hall", "head"], True))

    def testMisuseIsReportedInOneLineBeforeAnythingIsBuilt(self):
        for words, why in ((["--rounds", "0", "HEAD"], "whole number from 1"), (["HEAD", "--views", "hal"], "lattice_16"),
                           ([], "name one commit"), (["a", "b", "c"], "name one commit"), (["--fast"], "unknown option '--fast'"),
                           (["HEAD", "--rounds"], "needs a value"), (["no-such-commit"], "git has no commit 'no-such-commit'")):
            done = subprocess.run([sys.executable, "-B", SPEED, *words], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), words)
            self.assertIn(why, done.stderr)

    def testHelpTeaches(self):
        done = subprocess.run([sys.executable, "-B", SPEED, "--help"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        for said in ("Usage: tools/speed A [B]", "--rounds N", "--views LIST", "--remove", *speed.VIEWS):
            self.assertIn(said, done.stdout)

    def testRatiosAreOfPairsWithTheirSpread(self):
        self.assertEqual(speed.rowOf("hall", [10.0, 20.0, 40.0], [11.0, 20.0, 50.0]).split(),
                         ["hall", "20.0", "20.0", "1.100", "1.000", "to", "1.250"])

    def testAPictureCostsWhatAProgramTakesPerPictureBeyondTheFirst(self):
        with tempfile.TemporaryDirectory() as name:
            program = pathlib.Path(name) / "release" / "apps" / "tessera"
            program.parent.mkdir(parents=True)
            program.write_text('#!/bin/sh\nwhile [ "$1" != --frames ]; do shift; done\n'
                               'i=0; while [ $i -lt $(($2 * 100000)) ]; do i=$((i + 1)); done\n')
            program.chmod(0o755)
            before = speed.processorSeconds(program, ("hall", ), 1, pathlib.Path(name) / "pictures")
            self.assertGreater(before, 0.0)
            self.assertAlmostEqual(speed.pictureMs(program, "head", pathlib.Path(name) / "pictures") / (1000.0 * before), 1.0, delta=0.7)


if __name__ == "__main__":
    unittest.main()
