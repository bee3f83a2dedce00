// SPDX-License-Identifier: MIT
//
// From files in BehaviorTree.CPP's XML to a document; here is the order of the
// passes, and the one that reads <TreeNodesModel>.
//
//   parse_xml      text to elements, with columns              xml_text
//   load_files     the file and all it includes                source_files
//   ModelReader    <TreeNodesModel>                            here
//   read_trees     <BehaviorTree> to nodes                     trees
//
// Then `expand_btcpp` puts each subtree into its place (expand/expansion), and
// checks what only the whole tree shows. `btcheck explain` tells what each code
// means.
#include "model/btcpp/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/enumerators.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/outline.hpp"
#include "model/btcpp/source_files.hpp"
#include "model/btcpp/unknown_leaves.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/releases.hpp"
#include "text/choice.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

template <class Range, class Matches>
const typename Range::value_type* first_of(const Range& range,
                                           Matches&& matches) {
  const auto found = std::ranges::find_if(range, matches);
  return found == range.end() ? nullptr : &*found;
}

}  // namespace

std::optional<BtcppKind> kind_named(std::string_view tag) {
  const auto* name = first_of(
      kBtcppKindNames, [&](std::string_view each) { return each == tag; });
  if (name == nullptr) return std::nullopt;
  return static_cast<BtcppKind>(name - kBtcppKindNames.data());
}

const BtcppAttribute* find_attribute(
    const std::vector<BtcppAttribute>& attributes, std::string_view name) {
  return first_of(attributes, [&](const auto& a) { return a.name == name; });
}

const BtcppPort* BtcppModel::port(std::string_view wanted) const {
  return first_of(ports, [&](const auto& p) { return p.name == wanted; });
}

const BtcppTree* BtcppDocument::tree(std::string_view id) const {
  return first_of(trees, [&](const BtcppTree& t) { return t.id == id; });
}

const BtcppModel* BtcppDocument::model(std::string_view id) const {
  return first_of(models, [&](const BtcppModel& m) {
    return m.kind != BtcppKind::SubTree && m.id == id;
  });
}

const BtcppModel* BtcppDocument::subtree_model(std::string_view id) const {
  return first_of(models, [&](const BtcppModel& m) {
    return m.kind == BtcppKind::SubTree && m.id == id;
  });
}

namespace btcpp {
namespace {

// Nav2 writes `bidirectional_port`.
std::optional<BtcppDirection> direction_named(std::string_view tag) {
  if (tag == "input_port") return BtcppDirection::Input;
  if (tag == "output_port") return BtcppDirection::Output;
  if (tag == "inout_port" || tag == "bidirectional_port") {
    return BtcppDirection::InOut;
  }
  return std::nullopt;
}

// A node type that only version 4 has. A program of version 3 may have a leaf
// of the same name.
bool is_type_of_version_4(const XmlElement& element) {
  const std::string* id =
      kind_named(element.name) ? element.value("ID") : &element.name;
  if (id == nullptr || builtin_type(BtcppRelease::V3, *id) != nullptr) {
    return false;
  }
  const NodeTypeRow* row = builtin_type(BtcppRelease::V4, *id);
  return row != nullptr &&
         (!element.children.empty() || element.attribute("code") != nullptr);
}

// Whether version 3 refuses what is written in the trees, and version 4 does
// not.
bool speaks_version_4(const SourceFile& file) {
  return std::ranges::any_of(file.elements(), [&](const XmlElement& element) {
    const bool is_entry =
        file.elements()[element.parent].name == "TreeNodesModel";
    return !is_entry &&
           (std::ranges::any_of(element.attributes, is_condition_name,
                                &XmlAttribute::name) ||
            is_type_of_version_4(element));
  });
}

Finding ignored(const XmlElement& element, std::string_view help) {
  return {"BT1625", fmt::format("`<{}>` is ignored", element.name),
          "it means nothing here", std::string(help)};
}

void ignore(const SourceFile& file, const XmlElement& element,
            std::string_view help, FileFindings& findings) {
  findings.warning(file.place(element.span), ignored(element, help));
}

// Adds the models and enumerators of one file. A later model takes the place of
// an earlier one of the same kind and ID.
class ModelReader {
 public:
  ModelReader(const SourceFile& file, std::vector<BtcppModel>& models,
              FileFindings& findings)
      : file_(file), models_(models), findings_(findings) {}

  void read() {
    bool is_second = false;
    for (const std::size_t child : file_.root().children) {
      const XmlElement& list = file_.elements()[child];
      if (list.name != "TreeNodesModel") continue;
      if (is_second) {
        return findings_.error(file_.place(list.span),
                               {"BT1606", "a second `<TreeNodesModel>`",
                                "BehaviorTree.CPP takes one in each file",
                                "move its entries into the first"});
      }
      is_second = true;
      for (const std::size_t entry : list.children) {
        add_model(file_.elements()[entry]);
      }
    }
  }

 private:
  void add_model(const XmlElement& element) {
    if (element.name == "ScriptingEnum") return add_enumerator(element);
    const auto kind = kind_named(element.name);
    // The engine reads no models but those of SubTrees; this one describes a
    // node or, where editors leave an entry without a name, nothing.
    if (!kind) {
      return findings_.note(
          file_.place(element.span),
          ignored(element,
                  "a model is an Action, Condition, Control, Decorator or "
                  "SubTree"));
    }
    const std::string* id = element.value("ID");
    if (id == nullptr) {
      return findings_.error(
          file_.place(element.span),
          {"BT1604", "this model has no ID", "`ID` is missing",
           fmt::format("write `<{} ID=\"…\">`", element.name)});
    }
    BtcppModel model{*kind, *id, {}, {}, file_.place(element.span)};
    for (const std::size_t child : element.children) {
      add_to(model, file_.elements()[child]);
    }
    const auto same =
        std::ranges::find_if(models_, [&](const BtcppModel& other) {
          return other.kind == model.kind && other.id == model.id;
        });
    (same == models_.end() ? models_.emplace_back() : *same) = std::move(model);
  }

  // <ScriptingEnum name="RED" value="1"/>, a form of ours: the engine takes no
  // notice of it.
  void add_enumerator(const XmlElement& element) {
    const std::string name = element.value_or_empty("name");
    const XmlAttribute* value = element.attribute("value");
    const auto number =
        value != nullptr ? as_number<int>(value->value) : std::optional<int>();
    if (name.empty() || !number) {
      return findings_.error(
          file_.place(element.span),
          {"BT1604", "this enumerator has no name and number",
           name.empty() ? "`name` is missing" : "`value` is a whole number",
           "write `<ScriptingEnum name=\"RED\" value=\"1\"/>`"});
    }
    if (const auto first = btcpp::add_enumerator(models_, name, *number)) {
      findings_.error(file_.place(element.span),
                      two_numbers_of(name, *number, *first));
    }
  }

  void add_to(BtcppModel& model, const XmlElement& element) {
    if (const auto direction = direction_named(element.name)) {
      add_port(model, *direction, element);
    } else if (element.name == "MetadataFields") {
      for (const std::size_t child : element.children) {
        for (const auto& field : file_.elements()[child].attributes) {
          model.metadata.emplace_back(field.name, field.value);
        }
      }
    } else if (element.name != "description") {
      ignore(file_, element,
             "a model has input_port, output_port and inout_port", findings_);
    }
  }

  void add_port(BtcppModel& model, BtcppDirection direction,
                const XmlElement& element) {
    const XmlAttribute* name = element.attribute("name");
    if (name == nullptr) {
      return findings_.error(
          file_.place(element.span),
          {"BT1604", "this port has no name", "`name` is missing",
           fmt::format("write `<{} name=\"…\"/>`", element.name)});
    }
    // The engine's own model of a SubTree, as it writes it into logs, has it.
    if (name->value == "_autoremap") return;
    if (auto flaw = flaw_of_port_name(name->value)) {
      return findings_.warning(
          file_.place(name->value_span),
          {"BT1605", fmt::format("no port can be called `{}`", name->value),
           std::move(*flaw), "letters, digits and `_` are always allowed"});
    }
    BtcppPort port{direction,
                   name->value,
                   element.value_or_empty("type"),
                   {},
                   element.value_or_empty("description"),
                   file_.place(element.span)};
    if (const auto* value = element.value("default")) {
      port.default_value = *value;
    }
    if (port.description.empty()) port.description = element.text;
    model.ports.push_back(std::move(port));
  }

  const SourceFile& file_;
  std::vector<BtcppModel>& models_;
  FileFindings& findings_;
};

class DocumentReader {
 public:
  explicit DocumentReader(const BtcppOptions& options) : options_(options) {}

  Result<BtcppDocument> read(std::string_view name, const FileText& text,
                             const IncludeLoader& loader) {
    load_files(name, text, loader, sources_, findings_);
    if (loader) load_missing_trees(loader, sources_, findings_);
    tree_files_ = sources_.files.size();
    for (const InputFile& file : options_.models) {
      load_files(file.name, file.text, loader, sources_, findings_);
    }
    model_files_ = sources_.files.size();
    for (const InputFile& file : options_.neighbours) load_neighbour(file);
    // With a part of the files, nothing true could be said of the others.
    if (!findings_.has_error()) read_files();
    Result<BtcppDocument> result;
    // Before the texts are moved, which the findings quote.
    result.diagnostics = findings_.take();
    if (is_kept(result.diagnostics)) {
      std::ranges::move(sources_.texts, std::back_inserter(document_.files));
      result.value = std::move(document_);
    }
    return result;
  }

 private:
  bool is_kept(const std::vector<Diagnostic>& found) const {
    return std::ranges::all_of(found, [&](const Diagnostic& each) {
      const bool is_of_node = each.code == "BT1607" || each.code == "BT1621";
      return each.severity != Severity::Error ||
             (options_.keeps_faulty && is_of_node);
    });
  }

  // The file that was asked for comes after those it includes.
  const SourceFile& main_file() const {
    return sources_.files[tree_files_ - 1];
  }
  std::span<const SourceFile> tree_files() const {
    return files_between(0, tree_files_);
  }
  std::span<const SourceFile> files_between(std::size_t begin,
                                            std::size_t end) const {
    return std::span(sources_.files).subspan(begin, end - begin);
  }

  // Without what it includes.
  void load_neighbour(const InputFile& file) {
    if (is_loaded(sources_, file.name)) return;
    const auto outline = outline_of(file.text);
    if (!outline || !outline->has_node_models) return;
    load_files(
        file.name, file.text,
        [](const IncludeRequest& request) {
          return IncludedFile{std::string(request.path), "<root/>", ""};
        },
        sources_, findings_);
  }

  void take_models_of_neighbours() {
    if (model_files_ == sources_.files.size()) return;
    std::vector<BtcppModel> found;
    FileFindings ignored;
    for (const InputFile& file : sources_.texts) {
      ignored.add_file(file.name, file.text);
    }
    for (const SourceFile& file :
         files_between(model_files_, sources_.files.size())) {
      ModelReader(file, found, ignored).read();
    }
    for (BtcppModel& model : found) {
      const bool is_subtree = model.kind == BtcppKind::SubTree;
      if (is_subtree || document_.model(model.id) != nullptr ||
          known_type(document_.release, model.id) != nullptr) {
        continue;
      }
      document_.models.push_back(std::move(model));
    }
  }

  void read_files() {
    decide_release();
    if (findings_.has_error()) return;
    TreeContext context{document_, {}, 0};
    for (const SourceFile& file : files_between(tree_files_, model_files_)) {
      ModelReader(file, document_.models, findings_).read();
    }
    for (const SourceFile& file : tree_files()) {
      ModelReader(file, document_.models, findings_).read();
      note_tree_ids(file, context);
    }
    take_models_of_neighbours();
    for (const SourceFile& file : tree_files()) {
      read_trees(file, context, findings_);
      note_unread_attributes(file, document_, findings_);
    }
    take_described_trees();
    if (releases::kEachFileHasMainTree.has(document_.engine())) {
      for (const SourceFile& file : tree_files()) check_main_tree(file);
    }
    decide_main_tree();
    report_unknown_types();
    if (const auto* project = main_file().root().value("project_name")) {
      document_.project_name = *project;
    }
  }

  void decide_release() {
    const XmlElement& root = main_file().root();
    const XmlAttribute* format = root.attribute("BTCPP_format");
    const XmlAttribute* py_trees = root.attribute("py_trees");
    document_.read_for = options_.version;
    if (!options_.is_guess) document_.version = options_.version;
    const bool seems_3 = format == nullptr ? !speaks_version_4(main_file())
                                           : format->value.starts_with('3');
    document_.release =
        options_.release.value_or(py_trees != nullptr ? BtcppRelease::PyTrees
                                  : seems_3           ? BtcppRelease::V3
                                                      : BtcppRelease::V4);
    if (py_trees != nullptr) check_py_trees(*py_trees);
    if (options_.release || py_trees != nullptr) return;
    const bool is_v3 = document_.release == BtcppRelease::V3;
    if (format != nullptr && (is_v3 || format->value.starts_with('4'))) return;
    Finding finding{
        "BT1622",
        format == nullptr
            ? "the file does not say its version"
            : fmt::format("`{}` is no version of BehaviorTree.CPP",
                          format->value),
        fmt::format("read as version {}", is_v3 ? 3 : 4),
        "write `<root BTCPP_format=\"4\">` if it is for BehaviorTree.CPP 4"};
    // Older files do not say it.
    if (format == nullptr) {
      findings_.note(main_file().place(root.span), std::move(finding));
    } else {
      findings_.warning(main_file().place(root.span), std::move(finding));
    }
  }

  // `py_trees="2.2.3"`, in the root of a tree that was exported from Python.
  void check_py_trees(const XmlAttribute& release) {
    const BtcppPlace place = main_file().place(release.value_span);
    if (document_.release != BtcppRelease::PyTrees) {
      findings_.error(place, {"BT1660", "the file has a tree of py_trees",
                              "its nodes mean something else elsewhere",
                              fmt::format("leave {} out, or write `{}`",
                                          word(Choice::Profile),
                                          word(Choice::Profile, "py_trees"))});
    } else if (!release.value.starts_with("2.") && release.value != "2") {
      findings_.error(
          place,
          {"BT1660",
           fmt::format("trees of py_trees `{}` are not read", release.value),
           "version 2 is expected", "export it again, with py_trees 2.2"});
    }
  }

  void note_tree_ids(const SourceFile& file, TreeContext& context) {
    for (const std::size_t child : file.root().children) {
      const XmlElement& element = file.elements()[child];
      if (element.name == "BehaviorTree") {
        const std::string* id = element.value("ID");
        if (id != nullptr) context.tree_ids.insert(*id);
      } else if (element.name != "include" &&
                 element.name != "TreeNodesModel") {
        ignore(file, element,
               "a file holds include, BehaviorTree and TreeNodesModel",
               findings_);
      }
    }
  }

  // A SubTree whose tree is in no file is a leaf where it is described as one:
  // by a contract that has its very name, or as a tree that a library brings
  // along. Not in version 3, where its attributes mean something else.
  void take_described_trees() {
    if (document_.release == BtcppRelease::V3) return;
    std::set<std::string> told;
    std::optional<BtcppPlace> first;
    for (BtcppTree& tree : document_.trees) {
      for (BtcppNode& node : tree.nodes) {
        if (node.kind != BtcppKind::SubTree || document_.tree(node.id) ||
            !take_as_leaf(node)) {
          continue;
        }
        told.insert(node.id);
        if (!first) first = node.place;
      }
    }
    if (!first) return;
    findings_.note(
        *first,
        {"BT1656",
         fmt::format("no file here has the tree{} {}",
                     told.size() == 1 ? "" : "s",
                     listed({told.begin(), told.end()})),
         "taken as a leaf, as it is described",
         "name the folder that has the tree as well, to check what it does"});
  }

  bool take_as_leaf(BtcppNode& node) const {
    const bool is_of_library = library_type_of(node, node.children.size());
    const bool is_leaf =
        is_of_library || std::ranges::count(options_.described, node.id) > 0;
    // Such a tree could use any entry.
    const BtcppAttribute* shared = find_attribute(node.others, "_autoremap");
    const bool shares_all =
        shared != nullptr && parse_bool(shared->value) != false;
    if (!is_leaf || shares_all || !node.children.empty()) return false;
    node.kind = BtcppKind::Action;
    node.is_known = is_of_library;
    return true;
  }

  // VerifyXML before 3.7, of each file by itself.
  void check_main_tree(const SourceFile& file) {
    std::vector<std::string> ids;
    int count = 0;
    for (const std::size_t child : file.root().children) {
      const XmlElement& element = file.elements()[child];
      if (element.name != "BehaviorTree") continue;
      ++count;
      if (const auto* id = element.value("ID")) ids.push_back(*id);
    }
    const auto* main = file.root().value("main_tree_to_execute");
    if (main != nullptr ? std::ranges::count(ids, *main) > 0 : count == 1) {
      return;
    }
    Finding finding{
        "BT1611",
        main != nullptr
            ? fmt::format("no tree of the file is called `{}`", *main)
            : "the file does not say which tree runs",
        "BehaviorTree.CPP before 3.7 asks it of each file, included or not",
        "name one by `<root main_tree_to_execute=\"…\">`"};
    finding.refused_by = {releases::kEachFileHasMainTree};
    findings_.error(file.place(file.root().span), std::move(finding));
  }

  void decide_main_tree() {
    const SourceFile& file = main_file();
    if (const auto* id = file.root().value("main_tree_to_execute")) {
      document_.main_tree = *id;
      return;
    }
    std::vector<const BtcppTree*> own;
    for (const BtcppTree& tree : document_.trees) {
      if (tree.place.file == file.number) own.push_back(&tree);
    }
    if (document_.release == BtcppRelease::V4 && own.size() == 1) {
      document_.main_tree = own.front()->id;
    } else if (document_.trees.size() == 1) {
      document_.main_tree = document_.trees.front().id;
    } else if (is_project()) {
      document_.main_tree = named_by_files();
    }
  }

  bool is_project() const {
    return is_project_name(sources_.texts[main_file().number].name);
  }

  // Where they name one between them.
  std::optional<std::string> named_by_files() const {
    std::set<std::string> names;
    for (const SourceFile& file : tree_files()) {
      const auto* id = file.root().value("main_tree_to_execute");
      if (id != nullptr) names.insert(*id);
    }
    if (names.size() != 1) return std::nullopt;
    return *names.begin();
  }

  // Each type once, where it is first used; all leaves of which nothing is
  // known in one note.
  void report_unknown_types() {
    std::set<std::string> told;
    std::vector<const BtcppNode*> leaves;
    for (const BtcppTree& tree : document_.trees) {
      for (const BtcppNode& node : tree.nodes) {
        if (node.is_known || !told.insert(node.id).second) continue;
        if (is_described(node, options_.described)) continue;
        if (!report_unknown(node)) leaves.push_back(&node);
      }
    }
    if (!leaves.empty()) note_unknown_leaves(leaves);
  }

  // Other engines and textbooks have other names for the same.
  static std::string help_for_unknown(std::string_view id) {
    using Name = std::pair<std::string_view, std::string_view>;
    constexpr std::array<Name, 8> kElsewhere = {
        {{"Negation", "Inverter"},
         {"Not", "Inverter"},
         {"Negate", "Inverter"},
         {"Selector", "Fallback"},
         {"Priority", "Fallback"},
         {"Succeeder", "ForceSuccess"},
         {"Failer", "ForceFailure"},
         {"RepeatUntilFailure", "KeepRunningUntilFailure"}}};
    const auto found = std::ranges::find(kElsewhere, id, &Name::first);
    if (found == kElsewhere.end()) return "describe it in `<TreeNodesModel>`";
    return fmt::format(
        "BehaviorTree.CPP has `{}`; if it is your own, describe it in "
        "`<TreeNodesModel>`",
        found->second);
  }

  // False for a leaf of which there is nothing to say but that it is unknown.
  bool report_unknown(const BtcppNode& node) {
    const BtcppRelease release = document_.release;
    const OldName old = old_name(release, node.id);
    const std::vector<std::string> builtin = builtin_names(release);
    const auto near = closest_match(node.id, builtin);
    if (!old.today.empty() && old.is_refused) {
      report_old_name(node, old.today);
    } else if (near && is_refused_for_case(node, *near)) {
      findings_.error(
          node.place,
          {"BT1621", fmt::format("BehaviorTree.CPP has no node `{}`", node.id),
           "the case of letters counts", fmt::format("write `{}`", *near)});
    } else if (!node.children.empty()) {
      Finding finding{
          "BT1621", fmt::format("no model has the node `{}`", node.id),
          fmt::format("taken as a {}", kind_name(node.kind)),
          !old.today.empty() ? fmt::format("version 4 calls it `{}`", old.today)
          : near             ? fmt::format("did you mean `{}`?", *near)
                             : help_for_unknown(node.id)};
      // The program's own may well be described nowhere.
      if (old.today.empty() && !near) {
        findings_.note(node.place, std::move(finding));
      } else {
        findings_.warning(node.place, std::move(finding));
      }
    } else if (near) {
      findings_.note(
          node.place,
          {"BT1620", fmt::format("no model has the leaf `{}`", node.id),
           taken_as(node), fmt::format("did you mean `{}`?", *near)});
    } else {
      return false;
    }
    return true;
  }

  void report_old_name(const BtcppNode& node, std::string_view today) {
    findings_.error(
        node.place,
        {"BT1608", fmt::format("`<{}>` is written as in version 3", node.id),
         "version 4 does not know this node",
         today == "Precondition"
             ? "write `<Precondition if=\"…\">`, or `<ScriptCondition "
               "code=\"…\"/>` before its child"
             : fmt::format("write `<{}>`", today)});
  }

  // A leaf may be one of the program's; it registers no other `inverter`.
  bool is_refused_for_case(const BtcppNode& node, std::string_view near) const {
    return document_.release == BtcppRelease::V4 && !node.children.empty() &&
           equal_ignoring_case(node.id, near);
  }

  static std::string taken_as(const BtcppNode& leaf) {
    return leaf.kind == BtcppKind::Condition ? "taken as a condition"
                                             : "taken as an action, may run";
  }

  void note_unknown_leaves(const std::vector<const BtcppNode*>& leaves) {
    std::vector<std::string> names;
    std::vector<std::string> asking;
    bool is_guessed = true;
    for (const BtcppNode* leaf : leaves) {
      names.push_back(leaf->id);
      is_guessed = is_guessed && !leaf->is_explicit;
      if (!leaf->is_explicit && sounds_like_condition(leaf->id)) {
        asking.push_back(leaf->id);
      }
    }
    Finding finding{"BT1620",
                    leaves.size() == 1
                        ? fmt::format("no model has the leaf {}", listed(names))
                        : fmt::format("no model has {} leaves: {}",
                                      leaves.size(), listed(names)),
                    "", ""};
    finding.label = leaves.size() == 1 ? taken_as(*leaves[0])
                    : is_guessed       ? "each is taken as an action, may run"
                                       : "without a tag that says otherwise, "
                                         "each is taken as an action, may run";
    finding.help =
        asking.empty()
            ? fmt::format(
                  "describe them in `<TreeNodesModel>`, or by {}; `btcheck "
                  "leaves` begins either",
                  word(Choice::Leaves))
            : fmt::format(
                  "{} sound{} like {}: say so in `<TreeNodesModel>`, "
                  "or by {}; `btcheck leaves` begins either",
                  listed(asking), asking.size() == 1 ? "s" : "",
                  asking.size() == 1 ? "a condition" : "conditions",
                  word(Choice::Leaves));
    findings_.note(leaves.front()->place, std::move(finding));
  }

  const BtcppOptions& options_;
  SourceFiles sources_;
  std::size_t tree_files_ = 0;   // those after are models only
  std::size_t model_files_ = 0;  // and those after these, of neighbours
  FileFindings findings_;
  BtcppDocument document_;
};

}  // namespace
}  // namespace btcpp

Result<BtcppDocument> read_btcpp(std::string_view name, const FileText& text,
                                 const IncludeLoader& loader,
                                 const BtcppOptions& options) {
  return btcpp::DocumentReader(options).read(name, text, loader);
}

void ask_for_files(std::string_view name, const FileText& text,
                   const IncludeLoader& loader) {
  btcpp::SourceFiles files;
  btcpp::FileFindings findings;
  btcpp::load_files(name, text, loader, files, findings);
  btcpp::load_missing_trees(loader, files, findings);
}

}  // namespace btcheck
