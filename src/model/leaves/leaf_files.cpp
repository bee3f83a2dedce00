// SPDX-License-Identifier: MIT
//
// The forms are those of .btf files and read by the same readers; what they say
// of entries becomes scripts, so that XML trees have one kind of expression.
#include "model/leaves/leaf_files.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "model/btf/contracts.hpp"
#include "model/btf/forms.hpp"
#include "model/btf/lexer.hpp"
#include "model/leaves/contract_script.hpp"
#include "model/tree/node_types.hpp"
#include "text/findings.hpp"

namespace btcheck {
namespace {

// Reads the forms of one file.
class FormReader {
 public:
  FormReader(const btf::Reading& reading, std::uint32_t file,
             btcpp::LeafContracts& to)
      : reading_(reading), file_(file), to_(to) {}

  void read() {
    for (const btf::FormId id : reading_.forms.top_level) {
      const btf::Form* head = reading_.forms.head(id);
      if (head != nullptr && equal_ignoring_case(head->text, "defaction")) {
        read_contract(id, NodeType::Action);
      } else if (head != nullptr &&
                 equal_ignoring_case(head->text, "defcondition")) {
        read_contract(id, NodeType::Condition);
      } else if (head != nullptr && equal_ignoring_case(head->text, "defsv")) {
        read_first_value(id);
      } else if (reading_.forms.is_balanced) {
        refuse(head == nullptr ? reading_.form(id) : *head);
      }
    }
  }

 private:
  void read_contract(btf::FormId form, NodeType leaf) {
    auto draft = btf::read_contract_draft(reading_, form, leaf,
                                          btf::ContractPlace::SideFile);
    if (!draft) return;
    btcpp::LeafRule& rule = to_.rules.emplace_back();
    rule.file = file_;
    rule.leaf = leaf;
    rule.name = std::move(draft->name);
    rule.span = draft->span;
    if (draft->has_returns) rule.results = std::move(draft->results);
    rule.memory = draft->memory;
    rule.duration = draft->duration;
    if (draft->requirement) {
      rule.requirement = btf::condition_script(reading_, *draft->requirement);
    }
    rule.on_success = btf::effect_script(reading_, draft->on_success);
    rule.on_failure = btf::effect_script(reading_, draft->on_failure);
  }

  void read_first_value(btf::FormId form) {
    auto first = btf::first_value(reading_, form);
    if (!first) return;
    first->file = file_;
    to_.first_values.push_back(std::move(*first));
  }

  void refuse(const btf::Form& form) {
    reading_.findings.error(
        form.span,
        {"BT1004",
         form.is_list()
             ? std::string("this is no contract of a leaf")
             : fmt::format("`{}` is no contract of a leaf", form.text),
         "", "there are `defaction`, `defcondition` and `defsv`"});
  }

  const btf::Reading& reading_;
  std::uint32_t file_;
  btcpp::LeafContracts& to_;
};

std::vector<Diagnostic> read_file(const BtcppFile& file, std::uint32_t number,
                                  btcpp::LeafContracts& to) {
  const SourceText source(file.name, file.text);
  if (auto refusal = source.refuse_binary()) return {std::move(*refusal)};
  Findings findings(source);
  const btf::Forms forms =
      btf::read_forms(btf::split_words(file.text, findings), findings);
  const btf::Reading reading{forms, findings};
  if (forms.is_complete) FormReader(reading, number, to).read();
  return findings.take();
}

}  // namespace

Result<btcpp::LeafContracts> read_leaf_files(
    const std::vector<BtcppFile>& files) {
  Result<btcpp::LeafContracts> result;
  btcpp::LeafContracts all;
  for (std::uint32_t i = 0; i < files.size(); ++i) {
    auto found = read_file(files[i], i, all);
    std::move(found.begin(), found.end(),
              std::back_inserter(result.diagnostics));
  }
  if (has_error(result.diagnostics)) return result;
  all.files = files;
  result.value = std::move(all);
  return result;
}

}  // namespace btcheck
