// SPDX-License-Identifier: MIT
//
// The same texts go in as for a check, and the same errors come out. One model
// has one tick semantics: files that ask for different ones do not go into one.
#include "check/export/export_model.hpp"

#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <utility>

#include "check/export/claims.hpp"
#include "model/export/dot.hpp"
#include "model/export/layout.hpp"
#include "model/lowering.hpp"

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

 private:
  void add(std::vector<Diagnostic> found) {
    findings_.insert(findings_.end(), std::make_move_iterator(found.begin()),
                     std::make_move_iterator(found.end()));
  }

  // Reads and binds everything; false after an error.
  bool prepare() {
    auto tree =
        read_tree(tree_input_.name, tree_input_.text, tree_input_.reading);
    add(std::move(tree.diagnostics));
    for (const InputFile& input : properties_) {
      auto read = read_properties(input.name, input.text);
      add(std::move(read.diagnostics));
      if (!read.value) continue;
      inputs_.push_back(std::make_unique<BoundInput>(BoundInput{
          SourceText(input.name, input.text), std::move(*read.value)}));
    }
    if (has_error(findings_)) return false;
    tree_ = std::make_unique<BehaviorTree>(std::move(*tree.value));
    network_ = std::make_unique<Network>(lower(*tree_, ticks()));
    for (const auto& input : inputs_) {
      auto bound = bind_properties(*tree_, *network_, input->file,
                                   input->source, options_.extra);
      add(std::move(bound.diagnostics));
      if (!bound.value) continue;
      for (const BoundProperty& property : bound.value->properties) {
        for (const OpenComparison& each : property.comparisons) {
          findings_.push_back(each.refusal);
        }
      }
      input->bound = std::move(*bound.value);
    }
    return !has_error(findings_);
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
               "choose one by --tick, or export the files one by one");
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
      case ExportFormat::Dot:
        break;
    }
    if (!inputs_.empty()) {
      report(Severity::Warning, "BT0006", "a drawing has no properties",
             inputs_[0]->file);
    }
    return dot_text(*tree_, *network_);
  }

  std::string finished(Result<std::string> model, std::string_view before,
                       std::string_view behind) {
    add(std::move(model.diagnostics));
    std::string text = model.value.value_or("");
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
  return ModelExport(tree, properties, options).run();
}

}  // namespace btcheck
