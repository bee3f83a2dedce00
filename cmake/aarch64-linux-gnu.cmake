# SPDX-License-Identifier: MIT
#
# For 64-bit ARM, by Debian's cross compiler, which looks for headers that are
# the same everywhere in /usr/include, too.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Of toml++ only the headers are used, and its package is that of the machine.
set(tomlplusplus_DIR /usr/lib/x86_64-linux-gnu/cmake/tomlplusplus)
