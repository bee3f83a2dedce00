// SPDX-License-Identifier: MIT
//
// How files may be changed so that a finding is gone: what a kind of finding
// proposes, in terms of nodes, and what a check has confirmed, in lines.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace btcheck {

// Where a word begins, a node's type as a rule; as in SourceSpan.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;

  bool operator==(const SourcePlace&) const = default;
};

// A node to put in; its only child, if it has one, is a copy of one that is
// there.
struct NewNode {
  std::string type;
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::optional<SourcePlace> child = {};
};

// Attributes are those of XML, and the keywords of .btf without their colon.
struct SetAttribute {
  SourcePlace node;
  std::string name;
  std::string value;
};
struct RemoveAttribute {
  SourcePlace node;
  std::string name;
};
// Wherever a value of its attributes has it.
struct ReplaceInAttributes {
  SourcePlace node;
  std::string from;
  std::string to;
};
struct ReplaceWord {
  SourcePlace word;
  std::string from;
  std::string to;
};
struct ChangeType {
  SourcePlace node;
  std::string type;
};
// Puts siblings, from one to another, into a new node, between others.
struct WrapNodes {
  SourcePlace first;
  SourcePlace last;
  NewNode in;
  std::vector<NewNode> before = {};
  std::vector<NewNode> behind = {};
};
// Leaves the only child of a node in its place.
struct UnwrapNode {
  SourcePlace node;
};
struct InsertBefore {
  SourcePlace node;
  NewNode what;
};
struct MoveBefore {
  SourcePlace node;
  SourcePlace before;
};
using TreeEdit = std::variant<SetAttribute, RemoveAttribute,
                              ReplaceInAttributes, ReplaceWord, ChangeType,
                              WrapNodes, UnwrapNode, InsertBefore, MoveBefore>;

// Edits to be made one after the other. Each place is that of the file as it
// was before the first.
using Repair = std::vector<TreeEdit>;

// Lines [first, first + before.size()) of a file, and what stands there then.
struct ChangedLines {
  int first = 1;
  std::vector<std::string> before;
  std::vector<std::string> after;
};

// The number of the line behind those that go.
int line_behind(const ChangedLines& change);
// What stands there then, with the ends of its lines.
std::string text_put_in(const ChangedLines& change);

struct ChangedFile {
  std::string file;
  std::vector<ChangedLines> changes;  // from top to bottom
  // The lines around each change, for readers; "" where the file ends.
  std::vector<std::pair<std::string, std::string>> around;
};

// With these files changed the finding is gone, no other appears, and no rule
// that held breaks.
struct CheckedRepair {
  std::vector<ChangedFile> files;
  // The finding that proposed it, "BT1628 in line 12"; "" for this one.
  std::string comes_from = {};
};

// The lines that differ, few where few do, with the lines around them.
ChangedFile changed_lines(const std::string& file, const std::string& before,
                          const std::string& after);

// The same as a unified diff, byte for byte: for programs.
std::string unified_diff(const ChangedFile& file);

// A unified diff with a line of context, of at most so many lines; the last
// says how many are left out.
std::vector<std::string> diff_lines(const CheckedRepair& repair,
                                    std::size_t most);

}  // namespace btcheck
