"""Builds the Python module by CMake, for pip; docs/python.md says what must be installed before."""
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """The extension and its stubs, from the target wilt_python in build/pip."""

    def run(self):
        build = HERE / "build" / "pip"
        subprocess.run(["cmake", "-S", HERE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DWILT_PYTHON_MODULE=ON", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "wilt_python"], check=True)
        package = HERE / "python" / "wilt" if self.inplace else pathlib.Path(self.build_lib) / "wilt"
        package.mkdir(parents=True, exist_ok=True)
        for made in (build / "python" / "wilt").glob("_core.*"):
            shutil.copy2(made, package)


setup(version=re.search(r"project\(wilt VERSION ([\d.]+)", (HERE / "CMakeLists.txt").read_text()).group(1),
      ext_modules=[Extension("wilt._core", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
