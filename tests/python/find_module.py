"""The Python module that the tests are about, and NumPy; where one is missing the test ends here, with 77 (skipped)."""

import os
import pathlib
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
FOLDER = os.environ.get("TESSERA_PYTHON_MODULE", "")


def skip(reason):
    print("skipped:", reason)
    sys.exit(SKIPPED)


if not FOLDER:
    skip("the Python module is not built here; ./test --python builds it, and what it needs: pybind11-dev, python3-numpy")
try:
    import numpy
except ImportError:
    skip("NumPy is missing (Debian 12: apt-get install python3-numpy)")
sys.path.insert(0, FOLDER)
os.environ["PYTHONPATH"] = os.pathsep.join([FOLDER, *filter(None, [os.environ.get("PYTHONPATH")])])
import tessera  # a module that is there and cannot be imported is a fault
