// SPDX-License-Identifier: MIT
//
// `btcheck mcp`: the Model Context Protocol, tools and resources. After the
// specification of 2025-06-18; older versions are answered in their own.
#pragma once

#include "serve/server.hpp"

namespace btcheck {

const Protocol& mcp_protocol();

}  // namespace btcheck
