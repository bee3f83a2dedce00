// SPDX-License-Identifier: MIT
//
// A file of BehaviorTree.CPP and all it includes, as elements; and the trees in
// them, with the checks that need one node and its children only.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/xml_text.hpp"

namespace btcheck::btcpp {

struct SourceFile {
  std::uint32_t number = 0;                 // index into BtcppDocument::files
  std::shared_ptr<const ParsedXml> parsed;  // has a value

  const std::vector<XmlElement>& elements() const { return *parsed->value; }
  const XmlElement& root() const { return elements().front(); }
  BtcppPlace place(SourceSpan span) const { return {number, span}; }
};

struct SourceFiles {
  std::deque<InputFile> texts;    // never moved: findings point at them
  std::vector<SourceFile> files;  // an included file before the one including
};

bool is_loaded(const SourceFiles& files, std::string_view name);

// Loads each file once. A file that cannot be found or read is an error.
void load_files(std::string_view name, const FileText& text,
                const IncludeLoader& loader, SourceFiles& files,
                FileFindings& findings);

// Asks for the trees that are named and are in none of the files, and for what
// those name. The file that was loaded first stays the last.
void load_missing_trees(const IncludeLoader& loader, SourceFiles& files,
                        FileFindings& findings);

// What the reader of one tree needs to know of all files.
struct TreeContext {
  BtcppDocument& document;         // its models are complete
  std::set<std::string> tree_ids;  // of all files, also of those not yet read
  int unnamed = 0;                 // trees without an ID, so far
  std::set<std::string> told_names = {};  // old names of types, each told once
};

// Adds the trees of one file to the document. Of two of the same ID the later
// one counts, in version 3 the earlier one, with a warning.
void read_trees(const SourceFile& file, TreeContext& context,
                FileFindings& findings);

// One note of all attributes in the file that are not read, once its trees are
// in the document.
void note_unread_attributes(const SourceFile& file,
                            const BtcppDocument& document,
                            FileFindings& findings);

}  // namespace btcheck::btcpp
