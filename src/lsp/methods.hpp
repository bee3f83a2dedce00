// SPDX-License-Identifier: MIT
//
// The methods of the Language Server Protocol, and three more for editors that
// know btcheck: a page of a run, a drawing, a check at once.
#pragma once

#include "serve/server.hpp"

namespace btcheck::lsp {

const Protocol& lsp_protocol();

// Whether the editor has said that it is about to end.
bool is_shut_down();

}  // namespace btcheck::lsp
