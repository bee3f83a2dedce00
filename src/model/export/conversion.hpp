// SPDX-License-Identifier: MIT
//
// A tree in the other language: a .btf tree as XML of BehaviorTree.CPP 4, an
// XML tree as .btf.
#pragma once

#include <string>
#include <string_view>

#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A node type that both languages have.
struct Counterpart {
  NodeType type;
  std::string_view xml;  // its registered name; "" for leaves, which have an ID
  // How the engine's differs from that of .btf; "" where both do the same.
  std::string_view differs = {};
};

// nullptr for a type of one language only.
const Counterpart* counterpart_of(NodeType type);

// The text of the tree in the other language; one tick takes `tick_ms`. Errors
// (BT0010) name what the other language does not have, warnings (BT0011) what
// is left out, notes (BT0012) types that differ. `source` is the text of its
// file.
Result<std::string> xml_text(const BehaviorTree& tree, const SourceText& source,
                             int tick_ms);
Result<std::string> btf_text(const BehaviorTree& tree, const SourceText& source,
                             int tick_ms);

}  // namespace btcheck
