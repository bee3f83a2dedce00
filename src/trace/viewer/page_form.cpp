// SPDX-License-Identifier: MIT
#include "trace/viewer/page_form.hpp"

#include <cstddef>

namespace btcheck {

std::string filled(std::string_view form, const Gaps& gaps) {
  std::string page;
  for (const auto& [gap, text] : gaps) {
    const std::size_t at = form.find(gap);
    page += form.substr(0, at);
    page += text;
    form.remove_prefix(at + gap.size());
  }
  page += form;
  return page;
}

}  // namespace btcheck
