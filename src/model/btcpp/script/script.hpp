// SPDX-License-Identifier: MIT
//
// Scripts of BehaviorTree.CPP 4: their syntax, and the names in them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/script/tree.hpp"

namespace btcheck::btcpp {

// What a script does with a name.
enum class ScriptUse : unsigned char {
  Read,
  Create,  // x := …
  Change   // x = …, x += …: the entry must be there already
};

struct ScriptName {
  std::string name;  // with the '@' of the root's blackboard
  ScriptUse use = ScriptUse::Read;
  std::size_t at = 0;  // byte
};

struct ScriptSyntax {
  // Why it is no script, "an operand is missing", or "".
  std::string flaw;
  std::size_t flaw_at = 0;        // byte
  std::vector<ScriptName> names;  // in the order of the text
  ScriptTree tree;                // of a script without a flaw
};

ScriptSyntax parse_script(std::string_view script);

// The place of some bytes of a script; of the whole script when entities or
// line ends lie between them.
BtcppPlace place_in(const BtcppAttribute& script, std::size_t at,
                    std::size_t length);

}  // namespace btcheck::btcpp
