"""Puts surehit's shared library into the package, or finds an installed one.

SUREHIT_LIBRARY names a library to take. Without it, an installed library of the same version is used where it is, and
otherwise CMake builds one from the sources around this folder. CMAKE_ARGS has more arguments for CMake.
"""

import ctypes
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parents[2]
VERSION_HEADER = SOURCES / "collision/include/surehit/c/version.h"
C_ABI = 1


def version_of_sources():
    """Returns the three parts of the version, or None where the sources are not around this folder."""
    if not VERSION_HEADER.exists():
        return None
    text = VERSION_HEADER.read_text()
    parts = ("MAJOR", "MINOR", "PATCH")
    return tuple(int(re.search(rf"#define SUREHIT_VERSION_{part} (\d+)", text)[1]) for part in parts)


def loaded_version(name):
    """Returns the version of a library, or None if it cannot be loaded or is of another ABI."""
    try:
        library = ctypes.CDLL(name)
        if library.surehit_check_abi(C_ABI) != 0:
            return None
        number = library.surehit_version()
    except (OSError, AttributeError):
        return None
    return number // 1000000, number // 1000 % 1000, number % 1000


def library_name(version):
    """Returns the name of the shared library, which has its version in it where names of libraries have one."""
    short = f"{version[0]}.{version[1]}"
    return {"darwin": f"libsurehit.{short}.dylib", "win32": "surehit.dll"}.get(sys.platform, f"libsurehit.so.{short}")


NAMED = os.environ.get("SUREHIT_LIBRARY")
VERSION = version_of_sources()
if NAMED:
    VERSION = loaded_version(str(Path(NAMED).resolve()))
    if VERSION is None:
        sys.exit(f"error: SUREHIT_LIBRARY is {NAMED}, which is no surehit of ABI {C_ABI}")
elif VERSION is None:
    VERSION = loaded_version(library_name((0, 2)))
    if VERSION is None:
        sys.exit("error: there are no sources of surehit around this folder, and no installed library")
IS_INSTALLED = not NAMED and loaded_version(library_name(VERSION)) == VERSION


def has_avx2():
    """Returns whether this machine has AVX2, where that can be told."""
    try:
        return re.search(r"^flags\b.*\bavx2\b", Path("/proc/cpuinfo").read_text(), re.MULTILINE) is not None
    except OSError:
        return False


def built_library(folder):
    """Builds the library by CMake, and returns its path."""
    options = {"BUILD_SHARED_LIBS": "ON", "CMAKE_BUILD_TYPE": "Release", "SUREHIT_BUILD_TESTS": "OFF",
               "SUREHIT_BUILD_EXAMPLES": "OFF", "SUREHIT_INSTALL": "OFF", "SUREHIT_WARNINGS_AS_ERRORS": "OFF"}
    # Most of the time goes into code for each instruction set. With AVX2, the older ones are not used.
    if has_avx2():
        options["SUREHIT_INSTRUCTION_SETS_LEFT_OUT"] = "HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL"
    generator = ["-G", "Ninja"] if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ else []
    subprocess.run(["cmake", "-S", SOURCES, "-B", folder, *generator,
                    *(f"-D{name}={value}" for name, value in options.items()),
                    *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "surehit_collision", "--parallel",
                    str(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)],
                   check=True)
    return next(path for path in Path(folder).rglob(library_name(VERSION)))


class BuildWithLibrary(build_py):
    """Copies the library beside the modules, unless an installed one is used."""

    def run(self):
        super().run()
        if self.editable_mode or IS_INSTALLED:
            return
        build = self.get_finalized_command("build")
        library = NAMED or built_library(Path(build.build_temp).resolve())
        # The version in its name tells what was loaded, so the link is followed and its name is kept.
        shutil.copyfile(library, Path(self.build_lib) / "surehit" / library_name(VERSION))

    def get_outputs(self, include_bytecode=True):
        outputs = super().get_outputs(include_bytecode)
        if not self.editable_mode and not IS_INSTALLED:
            outputs.append(str(Path(self.build_lib) / "surehit" / library_name(VERSION)))
        return outputs


class PlatformWheel(bdist_wheel):
    """A wheel for every Python 3 of one platform."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = IS_INSTALLED

    def get_tag(self):
        tag = super().get_tag()
        return tag if IS_INSTALLED else ("py3", "none", tag[2])


setup(version=".".join(map(str, VERSION)), cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel})
