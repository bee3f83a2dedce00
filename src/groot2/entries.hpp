// SPDX-License-Identifier: MIT
//
// What a publisher says of blackboards: MessagePack, a map of each blackboard's
// entries by its name.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace btcheck::groot2 {

// The values as short texts, by the name of the blackboard and that of the
// entry, or what is wrong. Deeper nesting than a message of the engine can
// well have is refused, and long values are cut, so that no message takes much
// more than its own size.
struct EntriesRead {
  std::map<std::string, std::map<std::string, std::string>> boards;
  std::string flaw;
};
EntriesRead entries_in(std::string_view payload);

}  // namespace btcheck::groot2
