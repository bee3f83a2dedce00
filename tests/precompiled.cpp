// SPDX-License-Identifier: MIT
//
// Checks nothing: for the precompiled headers that the checks share.
