// SPDX-License-Identifier: MIT
//
// The same texts go in as for a check, and the same errors come out. One model
// has one tick semantics: files that ask for different ones do not go into one.
#include "check/export/export_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>

#include "check/bind/remembered.hpp"
#include "check/export/claims.hpp"
#include "check/export/ltsmin.hpp"
#include "ltl/rules/compared.hpp"
#include "model/export/conversion.hpp"
#include "model/export/dot.hpp"
#include "model/export/layout.hpp"
#include "model/lowering.hpp"
#include "model/sampling.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/cpp_monitor.hpp"
#include "trace/watch/monitor_table.hpp"

namespace btcheck {
namespace {

// A property file that has been read and bound; it stays where it is.
struct BoundInput {
  SourceText source;
  PropertyFile file;
  BoundFile bound = {};
};

class ModelExport {
 public:
  ModelExport(const TreeInput& tree, const std::vector<InputFile>& properties,
              const ExportOptions& options)
      : tree_input_(tree), properties_(properties), options_(options) {}

  Result<std::string> run() {
    Result<std::string> result;
    if (prepare()) result.value = text();
    result.diagnostics = std::move(findings_);
    if (has_error(result.diagnostics)) result.value.reset();
    return result;
  }

  Result<LtsminModel> run_for_ltsmin() {
    Result<LtsminModel> result;
    if (prepare()) {
      result.value.emplace();
      result.value->claims = claims<LtsminClaim>(ltsmin_claims);
      result.value->tree = std::move(tree_);
      result.value->network = std::move(network_);
    }
    result.diagnostics = std::move(findings_);
    return result;
  }

 private:
  void add(std::vector<Diagnostic> found) {
    findings_.insert(findings_.end(), std::make_move_iterator(found.begin()),
                     std::make_move_iterator(found.end()));
  }

  // Reads and binds everything; false after an error.
  bool prepare() {
    std::vector<Diagnostic> of_rules;
    TreeReading reading = tree_input_.reading;
    reading.detail.most_whole = most_whole();
    for (const InputFile& input : properties_) {
      auto read = read_properties(input.name, input.text);
      std::ranges::move(read.diagnostics, std::back_inserter(of_rules));
      if (!read.value) continue;
      add_compared(*read.value, reading.detail.asked, reading.detail.beside);
      inputs_.push_back(std::make_unique<BoundInput>(BoundInput{
          SourceText(input.name, input.text), std::move(*read.value)}));
    }
    auto tree = read_tree(tree_input_.name, tree_input_.text, reading);
    add(std::move(tree.diagnostics));
    add(std::move(of_rules));
    if (has_error(findings_)) return false;
    tree_ = std::make_unique<BehaviorTree>(std::move(*tree.value));
    if (!needs_network()) return true;
    std::vector<const PropertyFile*> rules;
    for (const auto& input : inputs_) rules.push_back(&input->file);
    const Lowering lowered = [&](const SampledValues& samples) {
      Network network = lower(*tree_, ticks(), samples);
      remember_for(*tree_, rules, network);
      return network;
    };
    network_ =
        std::make_unique<Network>(lower_to_bind(*tree_, lowered, most_whole()));
    std::vector<Expression> asked;
    for (const auto& input : inputs_) {
      auto bound = bind_properties(*tree_, *network_, input->file,
                                   input->source, options_.extra);
      add(std::move(bound.diagnostics));
      if (!bound.value) continue;
      const std::vector<Expression>& atoms = bound.value->atoms;
      asked.insert(asked.end(), atoms.begin(), atoms.end());
      for (const BoundProperty& property : bound.value->properties) {
        for (const OpenComparison& each : property.comparisons) {
          findings_.push_back(each.refusal);
        }
      }
      input->bound = std::move(*bound.value);
    }
    if (has_error(findings_)) return false;
    add(sample_regions(*tree_, {tree_input_.name, tree_input_.text}, asked,
                       lowered, *network_, most_whole()));
    tell_regions();
    return !has_error(findings_);
  }

  bool needs_network() const {
    return options_.format == ExportFormat::Automata ||
           options_.format == ExportFormat::Promela ||
           options_.format == ExportFormat::Smv ||
           options_.format == ExportFormat::Fiacre ||
           options_.format == ExportFormat::HFiacre ||
           options_.format == ExportFormat::Ltsmin;
  }

  // A drawing has all values that it can have, and so has what `space` counts.
  std::int64_t most_whole() const {
    const bool has_all =
        options_.format == ExportFormat::Automata ||
        (options_.format == ExportFormat::Ltsmin && properties_.empty());
    return has_all ? kMostSampled : kMostWhole;
  }

  void tell_region(const std::string& who, std::string_view does,
                   const StateVariable& variable, std::int64_t given) {
    const auto values = std::int64_t{variable.max} - variable.min + 1;
    if (variable.is_enumeration() || given == values) return;
    left_out_.push_back(fmt::format(
        "{} {} {} of the {} values of {}, one of each region that the tree and "
        "the claims tell apart",
        who, does, given, values, variable.name));
  }

  // Which SetSV, and which numbers that move, give one value of each region.
  void tell_regions() {
    for (std::uint32_t v = 0; v < tree_->variables.size(); ++v) {
      const auto automaton = network_->state_automaton[v];
      if (!automaton) continue;
      const StateVariable& variable = tree_->variables[v];
      const auto& moves = network_->automaton(*automaton).edges;
      if (variable.min == variable.max) continue;
      tell_region(variable.name, "takes", variable, std::ssize(moves));
    }
    for (std::uint32_t n = 0; n < tree_->nodes.size(); ++n) {
      const Node& node = tree_->nodes[n];
      if (node.type != NodeType::SetSV) continue;
      const StateVariable& variable = tree_->variable(node.variable);
      const Automaton& leaf = network_->automaton(NodeId{n});
      const auto given =
          std::ranges::count_if(leaf.edges, [&](const Edge& edge) {
            return leaf.target(edge).role == LocationRole::Success;
          });
      tell_region(short_name(*tree_, NodeId{n}), "measures", variable, given);
    }
  }

  TickSemantics ticks() {
    if (options_.ticks) return *options_.ticks;
    std::optional<TickSemantics> said;
    for (const auto& input : inputs_) {
      if (!input->file.ticks) continue;
      const auto ticks = tick_semantics(*input->file.ticks);
      if (said && ticks && *said != *ticks) {
        report(Severity::Error, "BT0005",
               "the property files ask for different tick semantics",
               input->file,
               fmt::format("choose one by {}, or export the files one by one",
                           word(Choice::Tick)));
      }
      if (!said) said = ticks;
    }
    return said.value_or(TickSemantics::Root);
  }

  void report(Severity severity, std::string_view code,
              std::string_view message, const PropertyFile& file,
              std::string_view help = {}) {
    Diagnostic& finding = findings_.emplace_back();
    finding.severity = severity;
    finding.code = code;
    finding.message = message;
    finding.file = file.file;
    finding.help = help;
  }

  // The claims of all files; names in a file are unique, between files they
  // get the file's number.
  template <class Claim, class Make>
  std::vector<Claim> claims(Make make) {
    std::vector<Claim> all;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      auto made = make(inputs_[i]->bound, inputs_[i]->source);
      for (Claim& claim : made.claims) {
        if (i > 0) claim.name += fmt::format("_of_file_{}", i + 1);
        all.push_back(std::move(claim));
      }
      for (const Diagnostic& finding : made.left_out) {
        left_out_.push_back(finding.message);
      }
      add(std::move(made.left_out));
    }
    return all;
  }

  std::string text() {
    switch (options_.format) {
      case ExportFormat::Promela:
        return finished(promela_text(*tree_, *network_,
                                     claims<ExportClaim>(promela_claims)),
                        "/* ", " */");
      case ExportFormat::Smv:
        return finished(
            smv_text(*tree_, *network_, claims<SmvClaim>(smv_claims)), "-- ",
            "");
      case ExportFormat::Fiacre:
        return finished(
            fiacre_text(*tree_, *network_, claims<ExportClaim>(fiacre_claims)),
            "/* ", " */");
      case ExportFormat::HFiacre:
        return linked();
      case ExportFormat::Xml:
      case ExportFormat::Btf:
        return converted();
      case ExportFormat::Monitor:
        return monitors();
      case ExportFormat::MonitorCpp: {
        const std::string table = monitors();
        return table.empty() ? "" : cpp_monitor(table, options_.space);
      }
      case ExportFormat::Ltsmin:
        return finished(
            {ltsmin_text(tree_input_.name, options_.words, *network_,
                         claims<LtsminClaim>(ltsmin_claims)),
             {}},
            "# ", "");
      case ExportFormat::Dot:
        return drawn(dot_tree);
      case ExportFormat::Svg:
        return drawn(svg_tree);
      case ExportFormat::Mermaid:
        return drawn(mermaid_tree);
      case ExportFormat::Automata:
        warn_of_properties("a drawing");
        return dot_text(*tree_, *network_);
    }
    return {};
  }

  template <class Draw>
  std::string drawn(Draw draw) {
    warn_of_properties("a drawing");
    return draw(recorded_tree(*tree_, tree_input_));
  }

  void warn_of_properties(std::string_view what) {
    if (inputs_.empty()) return;
    report(Severity::Warning, "BT0006",
           fmt::format("{} has no properties", what), inputs_[0]->file);
  }

  std::string converted() {
    warn_of_properties("a tree in the other language");
    const bool to_xml = options_.format == ExportFormat::Xml;
    const SourceText source(tree_input_.name, tree_input_.text);
    if (to_xml == is_engine(tree_->profile)) {
      findings_.push_back(source.diagnostic(
          Severity::Error, "BT0010", {},
          fmt::format("the tree is {} already", to_xml ? "XML" : ".btf"), "",
          "write " + word(Choice::Format, to_xml ? "btf" : "xml")));
      return "";
    }
    if (tree_->profile == Profile::PyTrees) {
      return refused(
          "a tree of py_trees has no counterpart in .btf",
          "export a model: " + word(Choice::Format, "promela, smv or fiacre"));
    }
    auto text = (to_xml ? xml_text : btf_text)(*tree_, source,
                                               tree_input_.reading.tick_ms);
    add(std::move(text.diagnostics));
    return text.value.value_or("");
  }

  // For Hippo, which runs the tree and proves nothing.
  std::string linked() {
    if (is_engine(tree_->profile)) {
      return refused("H-Fiacre is written of .btf trees alone",
                     "an XML tree has an executor of its own");
    }
    if (!inputs_.empty()) {
      return refused(
          "H-Fiacre is executed, and has no properties",
          fmt::format("leave {} out, or write {}", word(Choice::Rules),
                      word(Choice::Format, "fiacre")));
    }
    if (network_->ticks == TickSemantics::None) {
      return refused("without time nothing in H-Fiacre would be urgent",
                     "write " + word(Choice::Tick, "root"));
    }
    return finished(hfiacre_text(*tree_, *network_), "/* ", " */");
  }

  // The rules as a table.
  std::string monitors() {
    if (inputs_.size() != 1) {
      return refused(inputs_.empty() ? "there are no rules to be monitored"
                                     : "a table has the rules of one file",
                     "write " + word(Choice::Rules, "RULES.ltl"));
    }
    auto text = monitor_table(*tree_, recorded_tree(*tree_, tree_input_),
                              inputs_[0]->file, inputs_[0]->source);
    add(std::move(text.diagnostics));
    return text.value.value_or("");
  }

  // No such model of this tree.
  std::string refused(std::string_view message, std::string_view help) {
    Diagnostic& found = findings_.emplace_back();
    found.code = "BT0005";
    found.file = tree_->file;
    found.message = message;
    found.help = help;
    return "";
  }

  std::string finished(Result<std::string> model, std::string_view before,
                       std::string_view behind) {
    add(std::move(model.diagnostics));
    std::string text = model.value ? std::move(*model.value) : "";
    if (!left_out_.empty()) text += "\n";
    for (const std::string& message : left_out_) {
      text += fmt::format("{}{}{}\n", before, comment_text(message), behind);
    }
    return text;
  }

  const TreeInput& tree_input_;
  const std::vector<InputFile>& properties_;
  const ExportOptions& options_;
  std::unique_ptr<BehaviorTree> tree_;
  std::unique_ptr<Network> network_;
  std::vector<std::unique_ptr<BoundInput>> inputs_;
  std::vector<std::string> left_out_;
  std::vector<Diagnostic> findings_;
};

}  // namespace

Result<std::string> export_model(const TreeInput& tree,
                                 const std::vector<InputFile>& properties,
                                 const ExportOptions& options) {
  const Stage stage("the model was written");
  return ModelExport(tree, properties, options).run();
}

Result<LtsminModel> ltsmin_model(const TreeInput& tree,
                                 const std::vector<InputFile>& properties,
                                 const ExportOptions& options) {
  return ModelExport(tree, properties, options).run_for_ltsmin();
}

}  // namespace btcheck
