# SPDX-License-Identifier: MIT
"""Puts into the wheel what is made elsewhere: the version of CMakeLists.txt, the
licences, and the files that BTCHECK_PROGRAM and BTCHECK_LIBRARY name. The tag
of the wheel is that of the newest symbols that either asks the system for."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

# Where it is installed from, "pip wheel python/" or script/wheel.
HERE = Path(__file__).resolve().parent
SOURCES = HERE.parent
# What a wheel may ask the system for (PEP 600). A libstdc++ is not among it: that
# of a system may be older than ours.
SYSTEM = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1",
          "libgcc_s.so.1", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}


def version() -> str:
    text = (SOURCES / "CMakeLists.txt").read_text()
    return re.search(r"project\(btcheck VERSION ([0-9.]+)", text).group(1)


def made(variable: str) -> Path:
    name = os.environ.get(variable)
    if not name or not Path(name).is_file():
        sys.exit("setup.py: %s names no file: it is what the wheel carries" % variable)
    return Path(name).resolve()


def told_by(*words: object) -> str:
    return subprocess.run([str(word) for word in words], check=True,
                          capture_output=True, text=True).stdout


def newest_glibc(file: Path) -> "tuple[int, int]":
    """Of the symbols that it asks for; (0, 0) where it is static."""
    told = told_by("readelf", "-W", "-d", "-V", file)
    others = set(re.findall(r"\(NEEDED\).*\[(.*)\]", told)) - SYSTEM
    if others:
        sys.exit("setup.py: %s needs %s, which a system may not have"
                 % (file, ", ".join(sorted(others))))
    found = re.findall(r"Name: GLIBC_([0-9]+)\.([0-9]+)", told)
    return max(((int(major), int(minor)) for major, minor in found), default=(0, 0))


def platform() -> str:
    library, program = made("BTCHECK_LIBRARY"), made("BTCHECK_PROGRAM")
    machine = re.search(r"Machine:\s+(.*)", told_by("readelf", "-h", library)).group(1)
    names = {"Advanced Micro Devices X86-64": "x86_64", "AArch64": "aarch64"}
    if machine not in names:
        sys.exit("setup.py: wheels are made for x86_64 and aarch64, not for %s" % machine)
    major, minor = max((2, 17), newest_glibc(library), newest_glibc(program))
    return "manylinux_%d_%d_%s" % (major, minor, names[machine])


class Build(build_py):
    def run(self) -> None:
        super().run()
        to = Path(self.build_lib) / "btcheck"
        (to / "_version.py").write_text(
            '# SPDX-License-Identifier: MIT\nVERSION = "%s"\n' % version()
        )
        for variable, name in (("BTCHECK_LIBRARY", "libbtcheck.so"),
                               ("BTCHECK_PROGRAM", "program")):
            shutil.copyfile(made(variable), to / name)
            (to / name).chmod(0o755)


class Binary(Distribution):
    """It has files for one kind of machine."""

    def has_ext_modules(self) -> bool:
        return True


class Wheel(bdist_wheel):
    def get_tag(self) -> "tuple[str, str, str]":
        return "py3", "none", platform()


setup(version=version(), cmdclass={"build_py": Build, "bdist_wheel": Wheel},
      distclass=Binary, license_files=["LICENSE", "copyright", "licenses/*.txt"])
