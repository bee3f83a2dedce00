// SPDX-License-Identifier: MIT
//
// Includes are followed depth first, as in BehaviorTree.CPP, so that the files
// included by a file are read before it. There, a file that includes itself is
// read until memory runs out, and a file that is included twice is read twice;
// here the first is an error, and the second is read once.
#include "model/btcpp/source_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace btcheck::btcpp {
namespace {

constexpr std::size_t kMostFiles = 1000;
constexpr std::size_t kMostBytes = 16 << 20;

bool has_tree(const SourceFiles& files, std::string_view id) {
  return std::ranges::any_of(files.files, [&](const SourceFile& file) {
    return std::ranges::any_of(file.root().children, [&](std::size_t child) {
      const XmlElement& element = file.elements()[child];
      const std::string* own = element.value("ID");
      return element.name == "BehaviorTree" && own != nullptr && *own == id;
    });
  });
}

struct NamedTree {
  std::string id;
  BtcppPlace place;
};

std::vector<NamedTree> named_trees(const SourceFile& file) {
  std::vector<NamedTree> named;
  for (const XmlElement& element : file.elements()) {
    if (!element.name.starts_with("SubTree")) continue;
    if (file.elements()[element.parent].name == "TreeNodesModel") continue;
    const XmlAttribute* id = element.attribute("ID");
    if (id != nullptr) named.push_back({id->value, file.place(id->value_span)});
  }
  return named;
}

class Loading {
 public:
  Loading(const IncludeLoader& loader, SourceFiles& files,
          FileFindings& findings)
      : loader_(loader), files_(files), findings_(findings) {}

  void load(std::string_view name, const FileText& text) {
    open_file(std::string(name), text);
    while (!open_.empty()) {
      Open& last = open_.back();
      const auto& children = last.file.root().children;
      if (last.next_child == children.size()) {
        files_.files.push_back(std::move(last.file));
        open_.pop_back();
        continue;
      }
      const XmlElement& child =
          last.file.elements()[children[last.next_child++]];
      if (child.name == "include") include(child, last.file.number);
    }
  }

 private:
  struct Open {
    SourceFile file;
    std::size_t next_child = 0;
  };

  void open_file(std::string name, FileText text) {
    const auto number = static_cast<std::uint32_t>(files_.texts.size());
    files_.texts.push_back({std::move(name), std::move(text)});
    const InputFile& file = files_.texts.back();
    findings_.add_file(file.name, file.text);
    const SourceText& source = findings_.source(number);
    if (file.text.size() > kMostBytes) {
      return findings_.error({number, {}},
                             {"BT1602", "this file is larger than 16 MiB", "",
                              "split it, and include the parts"});
    }
    if (auto binary = source.refuse_binary()) return findings_.add({*binary});
    auto parsed = file.text.parsed<ParsedXml>();
    findings_.add(named(parsed->diagnostics, file.name));
    if (!parsed->value) return;
    const XmlElement& root = parsed->value->front();
    if (root.name != "root") {
      return findings_.error(
          {number, root.span},
          {"BT1601", fmt::format("the first element is `<{}>`", root.name),
           "`<root>` is expected",
           "put the trees into `<root BTCPP_format=\"4\">` and `</root>`"});
    }
    open_.push_back({{number, std::move(parsed)}});
  }

  void include(const XmlElement& element, std::uint32_t from) {
    const XmlAttribute* path = element.attribute("path");
    if (path == nullptr) {
      return findings_.error(
          {from, element.span},
          {"BT1603", "`<include>` names no file", "no `path`",
           "write `<include path=\"other.xml\"/>`"});
    }
    if (!loader_) {
      return refuse(from, *path, "files cannot be included here");
    }
    const std::string* package = element.value("ros_pkg");
    IncludedFile file =
        loader_({files_.texts[from].name, path->value,
                 package == nullptr ? std::string_view() : *package});
    if (is_open(file.name)) {
      return refuse(from, *path, "this file includes itself");
    }
    if (is_known(file.name)) return;
    if (!file.text) return refuse(from, *path, std::move(file.reason));
    if (files_.texts.size() == kMostFiles) {
      return findings_.error(
          {from, path->value_span},
          {"BT1602", fmt::format("more than {} files", kMostFiles), "",
           "include fewer files"});
    }
    open_file(std::move(file.name), std::move(*file.text));
  }

  void refuse(std::uint32_t from, const XmlAttribute& path,
              std::string reason) {
    findings_.error(
        {from, path.value_span},
        {"BT1603", fmt::format("`{}` cannot be included", path.value),
         std::move(reason),
         "a path counts from the folder of the file that includes; with "
         "`ros_pkg`, from the share folder of that package"});
  }

  bool is_open(std::string_view name) const {
    return std::ranges::any_of(open_, [&](const Open& open) {
      return files_.texts[open.file.number].name == name;
    });
  }

  bool is_known(std::string_view name) const { return is_loaded(files_, name); }

  const IncludeLoader& loader_;
  SourceFiles& files_;
  FileFindings& findings_;
  std::vector<Open> open_;
};

// The trees that were found beside the files that are included: one note.
class FoundBeside {
 public:
  void add(const std::string& id, const std::string& file,
           const BtcppPlace& place) {
    if (trees_.empty()) first_ = place;
    trees_.push_back(id);
    if (std::ranges::count(files_, file) == 0) files_.push_back(file);
  }

  void tell(FileFindings& findings) const {
    if (trees_.empty()) return;
    const bool is_one = files_.size() == 1;
    findings.note(
        first_,
        {"BT1649",
         fmt::format(
             "{} {} in {}`{}`", listed(trees_),
             trees_.size() == 1 ? "is" : "are",
             is_one ? "" : fmt::format("{} other files, first ", files_.size()),
             files_.front()),
         "in no file that is included",
         fmt::format("the program has to register {} as well; or write "
                     "`<include path=\"…\"/>`",
                     is_one ? "that file" : "those files")});
  }

 private:
  std::vector<std::string> trees_;
  std::vector<std::string> files_;
  BtcppPlace first_;
};

}  // namespace

bool is_loaded(const SourceFiles& files, std::string_view name) {
  return std::ranges::find(files.texts, name, &InputFile::name) !=
         files.texts.end();
}

void load_files(std::string_view name, const FileText& text,
                const IncludeLoader& loader, SourceFiles& files,
                FileFindings& findings) {
  Loading(loader, files, findings).load(name, text);
}

void load_missing_trees(const IncludeLoader& loader, SourceFiles& files,
                        FileFindings& findings) {
  const auto main = static_cast<std::ptrdiff_t>(files.files.size()) - 1;
  std::set<std::string> asked;
  FoundBeside beside;
  for (std::size_t f = 0; f < files.files.size(); ++f) {
    for (const auto& [id, place] : named_trees(files.files[f])) {
      if (!asked.insert(id).second || has_tree(files, id)) continue;
      const IncludedFile file =
          loader({files.texts[place.file].name, "", "", id});
      if (!file.text || is_loaded(files, file.name)) continue;
      load_files(file.name, *file.text, loader, files, findings);
      if (file.other.empty()) {
        beside.add(id, file.name, place);
        continue;
      }
      findings.warning(
          place, {"BT1649",
                  fmt::format("`{}` is in `{}`, and otherwise in `{}`", id,
                              file.name, file.other),
                  "the first is taken: both are as near",
                  "say which by `<include path=\"…\"/>`"});
    }
  }
  beside.tell(findings);
  if (main >= 0) {
    const auto at = files.files.begin() + main;
    std::rotate(at, at + 1, files.files.end());
  }
}

}  // namespace btcheck::btcpp
