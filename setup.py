"""Has CMake build the Python package, and puts it and the library's cases into a wheel: pip install . or pip wheel .

The extension links this machine's libraries (GSL, HDF5, ...), so the wheel is for machines with the same ones. CMake names
those that are missing; packaging/debian-packages.txt lists them all.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

root = Path(__file__).resolve().parent
build = root / "build" / "release"
build.parent.mkdir(exist_ok=True)  # setuptools's own files go there too


class ByCMake(build_py):
    """The package as CMake leaves it in the build folder, extension and its types included."""

    def run(self):
        cache = build / "CMakeCache.txt"
        if not cache.exists():
            subprocess.run(["cmake", "--preset", "command", "-D", "SOILBIN_PYTHON=ON"], cwd=root, check=True)
        elif "SOILBIN_PYTHON:BOOL=ON" not in cache.read_text():
            subprocess.run(["cmake", "-B", build, "-D", "SOILBIN_PYTHON=ON"], cwd=root, check=True)
        subprocess.run(["cmake", "--build", build, "-j", str(os.cpu_count()), "--target", "soilbin_python_package"],
                       cwd=root, check=True)
        shutil.copytree(build / "python" / "soilbin", Path(self.build_lib) / "soilbin", dirs_exist_ok=True,
                        ignore=shutil.ignore_patterns("__pycache__"))


class WithExtension(Distribution):
    def has_ext_modules(self):
        return True


def shared_files():
    """The library's cases, where the extension looks for them: share/soilbin/cases of the environment."""
    folders = [folder for folder, _, files in os.walk("cases") if files]
    return [(f"share/soilbin/{folder}", [str(file) for file in sorted(Path(folder).iterdir()) if file.is_file()])
            for folder in sorted(folders)]


setup(version=re.search(r"project\(soilbin VERSION (\S+)", (root / "CMakeLists.txt").read_text())[1],
      packages=["soilbin"], package_dir={"": "notebooks/python"}, distclass=WithExtension,
      cmdclass={"build_py": ByCMake}, data_files=shared_files(), options={"egg_info": {"egg_base": "build"}})
