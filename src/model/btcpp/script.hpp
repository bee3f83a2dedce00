// SPDX-License-Identifier: MIT
//
// Scripts of BehaviorTree.CPP 4: their syntax, and the names in them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

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
};

struct ScriptSyntax {
  // Why it is no script, "an operand is missing", or "".
  std::string flaw;
  std::size_t flaw_at = 0;        // byte
  std::vector<ScriptName> names;  // in the order of the text
};

ScriptSyntax parse_script(std::string_view script);

}  // namespace btcheck::btcpp
