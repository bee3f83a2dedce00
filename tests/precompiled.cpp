// SPDX-License-Identifier: MIT
//
// Compiles nothing: for the precompiled headers that the checks share.
