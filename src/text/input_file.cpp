// SPDX-License-Identifier: MIT
#include "text/input_file.hpp"

namespace btcheck {
namespace {

thread_local ParseCount* counting = nullptr;

}  // namespace

ParseCount::ParseCount() : before_(counting) { counting = this; }
ParseCount::~ParseCount() { counting = before_; }

void FileText::note_parse() const {
  if (counting != nullptr) ++counting->of_texts_[text()];
}

}  // namespace btcheck
