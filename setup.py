"""`pip install .`: builds the library and its Python module with CMake (see docs/python.md)."""

import os
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        source = Path(__file__).resolve().parent
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent
        # Not in setuptools' own folder: that is a new one for each run, and the library takes minutes to compile.
        build = Path(os.environ.get("TCM_ICP_BUILD_DIR", source / "build" / "pip"))
        subprocess.run(["cmake", "-S", str(source), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DTCM_ICP_PYTHON=ON", "-DTCM_ICP_BUILD_APP=OFF", "-DTCM_ICP_BUILD_TESTS=OFF",
                        f"-DPython_EXECUTABLE={sys.executable}", "-DTCM_ICP_PYTHON_DESTINATION=.",
                        f"-DCMAKE_INSTALL_PREFIX={target.parent}"], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        subprocess.run(["cmake", "--build", str(build), "--parallel", jobs], check=True)
        subprocess.run(["cmake", "--install", str(build), "--component", "python"], check=True)


setup(ext_modules=[Extension("tcm_icp._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
