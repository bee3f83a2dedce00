// SPDX-License-Identifier: MIT
//
// A file of BehaviorTree.CPP and all it includes, as elements.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/xml_text.hpp"

namespace btcheck::btcpp {

struct SourceFile {
  std::uint32_t number = 0;  // index into BtcppDocument::files
  std::vector<XmlElement> elements;

  const XmlElement& root() const { return elements.front(); }
  BtcppPlace place(SourceSpan span) const { return {number, span}; }
};

struct SourceFiles {
  std::deque<BtcppFile> texts;    // never moved: findings point at them
  std::vector<SourceFile> files;  // an included file before the one including
};

// Loads each file once. A file that cannot be found or read is an error.
void load_files(std::string_view name, std::string_view text,
                const IncludeLoader& loader, SourceFiles& files,
                FileFindings& findings);

}  // namespace btcheck::btcpp
