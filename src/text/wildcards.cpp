// SPDX-License-Identifier: MIT
#include "text/wildcards.hpp"

namespace btcheck {

// From left to right, with one place to go back to: what the last `*` stands
// for. An earlier one never has to be tried again, because whatever it could
// give up the last can take.
bool matches_wildcard(std::string_view pattern, std::string_view text) {
  std::size_t at = 0;  // in the pattern
  std::size_t star = pattern.npos;
  std::size_t taken = 0;  // where the text behind the last `*` begins
  for (std::size_t i = 0; i < text.size();) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      taken = i;
    } else if (at < pattern.size() &&
               (pattern[at] == '?' || pattern[at] == text[i])) {
      ++at;
      ++i;
    } else if (star != pattern.npos) {
      at = star + 1;
      i = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == pattern.npos;
}

bool matches_path(std::string_view pattern, std::string_view path) {
  const bool is_name = pattern.find('/') == pattern.npos;
  return matches_wildcard(pattern,
                          is_name ? path.substr(path.rfind('/') + 1) : path);
}

}  // namespace btcheck
