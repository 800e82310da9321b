"""Builds the compiled part with CMake. What is built goes to build/python of the project."""

import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent
build = here.parent.parent / "build" / "python"
build.mkdir(parents=True, exist_ok=True)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        target = Path(self.get_ext_fullpath(ext.name)).resolve()
        folder = build / "cmake"
        subprocess.run(
            ["cmake", "-S", here, "-B", folder,
             # as old and new versions of pybind11 call it
             f"-DPYTHON_EXECUTABLE={sys.executable}", f"-DPython_EXECUTABLE={sys.executable}",
             f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"],
            check=True)
        subprocess.run(["cmake", "--build", folder, "--parallel"], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(next(folder.rglob(target.name))), str(target))


setup(
    ext_modules=[Extension("arap_deformation._core", [])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": str(build / "setuptools")},
             "egg_info": {"egg_base": str(build)}})
