// SPDX-License-Identifier: MIT
//
// Thin: everything is in the library.
#include "cli/commands.hpp"

int main(int argc, char** argv) { return btcheck::run_program(argc, argv); }
