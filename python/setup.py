"""Builds the module for pip, from the source tree that this folder is part of: CMake does all of it, by the preset python."""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSION = re.search(r"project\(tessera VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        build = pathlib.Path(self.build_temp).resolve()
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        # The interpreter behind a virtual environment: it has the headers, and outlives the environment.
        python = os.path.realpath(sys.executable)
        for command in (["cmake", "--preset", "python", "-B", build, f"-DPython_EXECUTABLE={python}"],
                        ["cmake", "--build", build, "--target", "tessera_python"],
                        ["cmake", "--install", build, "--component", "python", "--prefix", target]):
            subprocess.run(command, cwd=ROOT, check=True)


setup(version=VERSION, packages=[], py_modules=[], ext_modules=[Extension("tessera", [])], cmdclass={"build_ext": BuildByCMake})
