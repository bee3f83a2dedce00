// SPDX-License-Identifier: MIT
//
// From the text of a .btf file to a behavior tree. This file is the order of
// the passes:
//
//   read_forms     characters to words, to nested lists    forms
//   Clauses        a list to keywords, values and items    keywords, durations
//   Variables      (defsv …)                               variables
//   read_tree      (BehaviorTree …) to its own nodes       nodes
//   TreeForms      roots, and subtrees in their places     references
//   NodeNames      which node `name.rstatus` means         references
//   Functions      (defun …)                               functions
//   read_arguments what :args hand over                    arguments
//   read_condition expressions, once every name is known   expression, operand
//   Contracts      (defaction …), (defcondition …)         contracts
//
// A pass reports what is wrong and goes on with what it could make of it; only
// a file that is no text, or past a limit, ends the reading early.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/btf/arguments.hpp"
#include "model/btf/contracts.hpp"
#include "model/btf/expression.hpp"
#include "model/btf/functions.hpp"
#include "model/btf/trees.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "text/findings.hpp"

namespace btcheck {
namespace btf {
namespace {

constexpr std::size_t kMostBytes = 16 << 20;

class FileReader {
 public:
  explicit FileReader(const Reading& reading) : reading_(reading) {}

  BehaviorTree read() {
    sort_forms();
    std::vector<TreeDraft> drafts;
    for (const FormId form : tree_forms_) {
      drafts.push_back(read_tree(reading_, variables_, form));
    }
    const TreeForms trees(reading_, std::move(drafts));
    const std::vector<TreeNumber> roots = trees.roots(trees_forms_);
    check_unused(trees, roots);
    TreeForms::Expansion all = trees.expand(roots);
    finish(all, false);
    if (tree_forms_.empty()) report_no_tree();
    if (!all.tree.nodes.empty()) {
      const NodeNames names(all.tree);
      const Scope scope{reading_, variables_, names, NodeId{0}, &functions_};
      contracts_.report_unused(scope);
      functions_.report_unused(scope);
    }
    all.tree.variables = variables_.take();
    refuse_written_clocks(all.tree);
    return std::move(all.tree);
  }

 private:
  // What moves in its own time would have two masters.
  void refuse_written_clocks(const BehaviorTree& tree) const {
    for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
      const StateVariable& variable = tree.variables[v];
      const auto writer = std::ranges::find_if(
          tree.nodes,
          [&](const Node& node) { return writes(node, StateVariableId{v}); });
      if (variable.lasting.empty() || writer == tree.nodes.end()) continue;
      reading_.error(
          variable.span, "BT1010",
          fmt::format("`{}` moves in its own time, and the tree writes it",
                      variable.name),
          fmt::format("written by the {} on line {}", type_name(writer->type),
                      writer->span.line),
          "leave the times of its `:transitions` out, or what writes it");
    }
  }

  // Declarations are read at once; trees wait until all are known.
  void sort_forms() {
    for (const FormId id : reading_.forms.top_level) {
      const Form* head = reading_.forms.head(id);
      if (!head) {
        report_stray(reading_.form(id));
      } else if (is_head(*head, "defsv")) {
        variables_.declare(reading_, id);
      } else if (is_head(*head, "BehaviorTree")) {
        tree_forms_.push_back(id);
      } else if (is_head(*head, "Trees")) {
        trees_forms_.push_back(id);
      } else if (is_head(*head, "defun")) {
        functions_.declare(reading_, id);
      } else if (is_head(*head, "defaction")) {
        contracts_.declare(reading_, id, NodeType::Action);
      } else if (is_head(*head, "defcondition")) {
        contracts_.declare(reading_, id, NodeType::Condition);
      } else {
        report_unknown(*head);
      }
    }
  }

  bool is_head(const Form& head, std::string_view name) const {
    if (!equal_ignoring_case(head.text, name)) return false;
    reading_.findings.case_warning(head.span, head.text, name);
    return true;
  }

  void report_stray(const Form& form) const {
    if (!reading_.forms.is_balanced) return;
    reading_.error(
        form.span, "BT1003",
        form.is_list()
            ? std::string("a list that begins with no word")
            : fmt::format("`{}` stands outside of every form", form.text),
        "", "a file consists of forms such as `(BehaviorTree ...)`");
  }

  // After a parenthesis went wrong, nodes end up at the top through no fault
  // of their own.
  void report_unknown(const Form& head) const {
    const bool is_node = find_node_type(head.text).has_value();
    if (is_node && !reading_.forms.is_balanced) return;
    const std::vector<std::string> known = definition_words();
    reading_.error(
        head.span, "BT1004",
        is_node ? fmt::format("`{}` stands outside of every BehaviorTree",
                              head.text)
                : fmt::format("unknown form `{}`", head.text),
        "",
        is_node ? "write `(BehaviorTree :name main (...))` around it"
                : nearest_or_all(head.text, known));
  }

  void report_no_tree() const {
    reading_.error(SourceSpan{}, "BT1019",
                   reading_.forms.tokens.empty()
                       ? "the file is empty"
                       : "there is no BehaviorTree in this file",
                   "", "write `(BehaviorTree :name main (...))`");
  }

  // Trees that do not run are checked like the others, and dropped.
  void check_unused(const TreeForms& trees,
                    const std::vector<TreeNumber>& roots) {
    const std::vector<TreeNumber> unused = trees.unused(roots);
    if (unused.empty()) return;
    TreeForms::Expansion dropped = trees.expand(unused);
    for (const NodeId root : dropped.tree.roots) {
      const Node& node = dropped.tree.node(root);
      reading_.findings.warning(
          node.span,
          {"BT1021", fmt::format("the tree `{}` is not used", node.name),
           "neither run nor a subtree of one that is", ""});
    }
    finish(dropped, true);
  }

  // What needs every name: arguments, expressions and contracts. A SubTree
  // stands before its nodes, so what its arguments are is known there.
  void finish(TreeForms::Expansion& all, bool is_unused) {
    const NodeNames names(all.tree);
    const std::size_t count = all.tree.nodes.size();
    std::vector<std::unique_ptr<Bindings>> made(count);
    std::vector<const Bindings*> around(count);
    for (std::size_t i = 0; i < count; ++i) {
      Node& node = all.tree.nodes[i];
      const NodeId id{static_cast<std::uint32_t>(i)};
      const std::uint32_t parent = index(node.parent);
      around[i] = made[parent] ? made[parent].get() : around[parent];
      const Scope scope{reading_,    variables_, names,    id,
                        &functions_, {},         is_unused};
      made[i] = finish_node(scope, around[i], *all.drafts[i], node);
    }
  }

  // Returns what the arguments of a SubTree stand for.
  std::unique_ptr<Bindings> finish_node(Scope scope, const Bindings* around,
                                        const NodeDraft& draft, Node& node) {
    if (node.type == NodeType::Action || node.type == NodeType::Condition) {
      contracts_.apply(scope, node);
    }
    const auto form = draft.expression ? draft.expression : draft.arguments;
    scope.bindings = around;
    const bool is_bound = around && form && mentions(reading_, *form, *around);
    const std::string use =
        is_bound ? fmt::format("as used on line {}", around->line) : "";
    const Reading reading{reading_.forms, reading_.findings, use};
    const Scope told{reading,        scope.variables, scope.nodes,
                     scope.from,     scope.functions, around,
                     scope.is_unused};
    if (draft.expression) finish_eval(told, *draft.expression, node);
    auto bindings = std::make_unique<Bindings>();
    if (draft.arguments) {
      *bindings = read_arguments(told, *draft.arguments, node);
    }
    if (node.type != NodeType::SubTree) return nullptr;
    bindings->line = node.span.line;
    warn_of_hidden(*bindings, node);
    return bindings;
  }

  // A key of a SubTree that is the name of a variable as well; `level $level`
  // is the same.
  void warn_of_hidden(const Bindings& bindings, const Node& node) {
    for (const Argument& argument : node.arguments) {
      const auto declared = variables_.declared(argument.key);
      const Operand& value = bindings.by_key.at(name_key(argument.key)).value;
      if (!declared || value.variable == declared) continue;
      reading_.findings.warning(
          argument.span,
          {"BT1024",
           fmt::format("in the subtree, `{}` is this value", argument.key),
           "no longer the state variable", "give the argument another name"});
    }
  }

  void finish_eval(const Scope& scope, FormId expression, Node& node) {
    if (is_assignment(reading_, expression)) {
      node.assignment = read_assignment(scope, expression);
    } else if (auto value = read_condition(scope, expression)) {
      node.expression = *std::move(value);
    }
  }

  const Reading& reading_;
  Variables variables_;
  Contracts contracts_;
  Functions functions_;
  std::vector<FormId> tree_forms_;
  std::vector<FormId> trees_forms_;
};

}  // namespace

std::vector<std::string> definition_words() {
  return {"defsv",     "BehaviorTree", "Trees",
          "defaction", "defcondition", "defun"};
}

}  // namespace btf

Result<BehaviorTree> read_btf(std::string_view file_name, const FileText& text,
                              int tick_ms) {
  const SourceText source(file_name, text);
  if (auto refusal = source.refuse_binary()) return {{}, {*refusal}};
  if (text.size() > btf::kMostBytes) {
    return {
        {},
        {source.diagnostic(Severity::Error, "BT1002", {},
                           "the file is larger than 16 MiB", "", "split it")}};
  }
  const auto parsed = text.parsed<btf::ParsedForms>();
  const btf::Forms& forms = parsed->forms;
  Findings findings(source, parsed->findings);
  if (!forms.is_complete) return {{}, findings.take()};
  const btf::Reading reading{forms, findings, {}, tick_ms};
  BehaviorTree tree = btf::FileReader(reading).read();
  tree.file = file_name;
  if (findings.has_error()) return {{}, findings.take()};
  assert(!tree.roots.empty());
  return {std::move(tree), findings.take()};
}

}  // namespace btcheck
