// SPDX-License-Identifier: MIT
//
// What `btcheck serve` answers: each method is the command of its name.
#pragma once

#include "serve/server.hpp"

namespace btcheck {

const Protocol& serve_protocol();

}  // namespace btcheck
