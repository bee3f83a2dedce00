// SPDX-License-Identifier: MIT
#include "model/btcpp/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "model/btcpp/names.hpp"

namespace btcheck::btcpp {
namespace {

std::optional<BtcppKind> kind_named(std::string_view tag) {
  for (std::size_t i = 0; i < kBtcppKindNames.size(); ++i) {
    if (kBtcppKindNames[i] == tag) return static_cast<BtcppKind>(i);
  }
  return std::nullopt;
}

// Nav2 writes `bidirectional_port`.
std::optional<BtcppDirection> direction_named(std::string_view tag) {
  if (tag == "input_port") return BtcppDirection::Input;
  if (tag == "output_port") return BtcppDirection::Output;
  if (tag == "inout_port" || tag == "bidirectional_port") {
    return BtcppDirection::InOut;
  }
  return std::nullopt;
}

std::string value_or_empty(const XmlElement& element, std::string_view name) {
  const std::string* value = element.value(name);
  return value == nullptr ? std::string() : *value;
}

class ModelReader {
 public:
  ModelReader(const SourceFile& file, FileFindings& findings)
      : file_(file), findings_(findings) {}

  std::optional<BtcppModel> read(const XmlElement& element) {
    const auto kind = kind_named(element.name);
    if (!kind) {
      ignore(element,
             "a model is an Action, Condition, Control, Decorator or "
             "SubTree");
      return std::nullopt;
    }
    const std::string* id = element.value("ID");
    if (id == nullptr) {
      findings_.error(file_.place(element.span),
                      {"BT1604", "this model has no ID", "`ID` is missing",
                       fmt::format("write `<{} ID=\"…\">`", element.name)});
      return std::nullopt;
    }
    BtcppModel model{*kind, *id, {}, {}, file_.place(element.span)};
    for (const std::size_t child : element.children) {
      add_to(model, file_.elements[child]);
    }
    return model;
  }

 private:
  void add_to(BtcppModel& model, const XmlElement& element) {
    if (const auto direction = direction_named(element.name)) {
      add_port(model, *direction, element);
    } else if (element.name == "MetadataFields") {
      for (const std::size_t child : element.children) {
        for (const auto& field : file_.elements[child].attributes) {
          model.metadata.emplace_back(field.name, field.value);
        }
      }
    } else if (element.name != "description") {
      ignore(element, "a model has input_port, output_port and inout_port");
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
    if (auto flaw = flaw_of_port_name(name->value)) {
      return findings_.error(
          file_.place(name->value_span),
          {"BT1605", fmt::format("no port can be called `{}`", name->value),
           std::move(*flaw), "letters, digits and `_` are always allowed"});
    }
    BtcppPort port{direction,
                   name->value,
                   value_or_empty(element, "type"),
                   {},
                   value_or_empty(element, "description"),
                   file_.place(element.span)};
    if (const auto* value = element.value("default")) {
      port.default_value = *value;
    }
    if (port.description.empty()) port.description = element.text;
    model.ports.push_back(std::move(port));
  }

  void ignore(const XmlElement& element, std::string_view help) {
    findings_.warning(file_.place(element.span),
                      {"BT1625", fmt::format("`<{}>` is ignored", element.name),
                       "it means nothing here", std::string(help)});
  }

  const SourceFile& file_;
  FileFindings& findings_;
};

void add_model(BtcppModel model, std::vector<BtcppModel>& models) {
  const auto same =
      std::find_if(models.begin(), models.end(), [&](const BtcppModel& other) {
        return other.kind == model.kind && other.id == model.id;
      });
  if (same == models.end()) {
    models.push_back(std::move(model));
  } else {
    *same = std::move(model);
  }
}

}  // namespace

void read_models(const SourceFile& file, std::vector<BtcppModel>& models,
                 FileFindings& findings) {
  bool is_second = false;
  for (const std::size_t child : file.root().children) {
    const XmlElement& list = file.elements[child];
    if (list.name != "TreeNodesModel") continue;
    if (is_second) {
      findings.error(file.place(list.span),
                     {"BT1606", "a second `<TreeNodesModel>`",
                      "BehaviorTree.CPP takes one in each file",
                      "move its entries into the first"});
      return;
    }
    is_second = true;
    ModelReader reader(file, findings);
    for (const std::size_t entry : list.children) {
      auto model = reader.read(file.elements[entry]);
      if (model) add_model(std::move(*model), models);
    }
  }
}

}  // namespace btcheck::btcpp
