// SPDX-License-Identifier: MIT
//
// libbtcheck-pins.so: a PinsModel behind the interface of LTSmin's language
// modules (ltsmin/pins.h, 3.1). Nothing of ours may leave by an exception: what
// is wrong is told, and LTSmin ends by its own way out.
#include "pins/model.hpp"

#include <array>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <set>

#include "cli/inputs/inputs.hpp"

extern "C" {
#include <ltsmin/dlopen-api.h>
#include <ltsmin/ltsmin-standard.h>
#include <ltsmin/pins-util.h>
#include <ltsmin/pins.h>
}

namespace btcheck {
namespace {

// --- What is asked while a search goes on --------------------------------

const PinsModel& model_of(model_t self) {
  return *static_cast<const PinsModel*>(GBgetContext(self));
}

// The labels of the steps of a group: action, node, progress.
std::array<int, 3> edge_labels(const PinsModel& model, std::uint32_t group) {
  return {static_cast<int>(group), static_cast<int>(model.mover(group)),
          model.is_progress(group) ? 1 : 0};
}

// Hands on what a model tells of its steps.
class Callback {
 public:
  Callback(const PinsModel& model, TransitionCB call, void* context)
      : model_(model), call_(call), context_(context) {}

  void operator()(std::uint32_t group, int* target) const {
    auto labels = edge_labels(model_, group);
    transition_info_t info = GB_TI(labels.data(), static_cast<int>(group));
    call_(context_, &info, target, nullptr);
  }

 private:
  const PinsModel& model_;
  TransitionCB call_;
  void* context_;
};

int all_steps(model_t self, int* state, TransitionCB call, void* context) {
  const PinsModel& model = model_of(self);
  return model.steps(state, Callback(model, call, context));
}

int steps_of_group(model_t self, int group, int* state, TransitionCB call,
                   void* context) {
  const PinsModel& model = model_of(self);
  return model.steps_of(static_cast<std::uint32_t>(group), state,
                        Callback(model, call, context));
}

std::size_t guard_count(const PinsModel& model) {
  return model.guards() == nullptr ? 0 : model.guards()->size();
}
std::size_t label_count(const PinsModel& model) {
  return guard_count(model) + model.labels().size();
}

// Guards come first, as LTSmin expects them, and labels of rules behind them.
int label_of(model_t self, int label, int* state) {
  const PinsModel& model = model_of(self);
  const auto number = static_cast<std::size_t>(label);
  const std::size_t guards = guard_count(model);
  return number < guards
             ? model.guard(static_cast<std::uint32_t>(number), state)
             : model.label(number - guards, state);
}

void first_labels(std::size_t count, model_t self, int* state, int* labels) {
  for (std::size_t i = 0; i < count; ++i) {
    labels[i] = label_of(self, static_cast<int>(i), state);
  }
}

void all_labels(model_t self, int* state, int* labels) {
  first_labels(label_count(model_of(self)), self, state, labels);
}

void labels_of_group(model_t self, sl_group_enum_t group, int* state,
                     int* labels) {
  const PinsModel& model = model_of(self);
  first_labels(group == GB_SL_GUARDS ? guard_count(model) : label_count(model),
               self, state, labels);
}

// The groups whose steps have this value of an edge label.
int groups_of_edge(model_t self, int label, int value, int* groups) {
  const PinsModel& model = model_of(self);
  int count = 0;
  for (std::uint32_t group = 0; group < model.groups().size(); ++group) {
    const auto labels = edge_labels(model, group);
    if (labels[static_cast<std::size_t>(label)] != value) continue;
    if (groups != nullptr) groups[count] = static_cast<int>(group);
    ++count;
  }
  return count;
}

// --- What is said beforehand ---------------------------------------------

// Types and names, and the texts of values once LTSmin has tables for them.
class Declaration {
 public:
  Declaration(model_t self, const PinsModel& model)
      : self_(self), model_(model), type_(lts_type_create()) {}

  void declare() {
    tells_names_ = model_.choices().tells_names || has_few_types();
    declare_slots();
    declare_steps();
    declare_labels();
    lts_type_validate(type_);
    GBsetLTStype(self_, type_);
    for (const auto& [type, names] : named_) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string& name = names[i];
        pins_chunk_put_at(self_, type,
                          {static_cast<chunk_len>(name.size()),
                           const_cast<char*>(name.data())},
                          static_cast<int>(i));
      }
    }
  }

 private:
  int type(const std::string& name, data_format_t format) {
    return lts_type_put_type(type_, name.c_str(), format, nullptr);
  }
  int type_of_names(const std::string& name,
                    const std::vector<std::string>& names) {
    const auto [known, is_new] = types_.try_emplace(names, 0);
    if (is_new) {
      known->second = type(name, LTStypeEnum);
      named_.emplace_back(known->second, names);
    }
    return known->second;
  }
  int type_of_slot(std::size_t slot) {
    const auto names = model_.value_names(slot);
    if (tells_names_ && !names.empty()) {
      return type_of_names(model_.slot_name(slot), names);
    }
    return model_.choices().slots == SlotKind::Packed
               ? type("word", LTStypeDirect)
               : type("number", LTStypeSInt32);
  }

  // With more than about 64 types the distributed tools of LTSmin 3.1 crash.
  bool has_few_types() const {
    constexpr std::size_t kMostTypes = 48;
    std::set<std::vector<std::string>> lists;
    for (std::size_t slot = 0; slot < model_.slots().size(); ++slot) {
      lists.insert(model_.value_names(slot));
    }
    return lists.size() <= kMostTypes;
  }

  void declare_slots() {
    const auto count = static_cast<int>(model_.slots().size());
    lts_type_set_state_length(type_, count);
    for (int i = 0; i < count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      lts_type_set_state_name(type_, i, model_.slot_name(slot).c_str());
      lts_type_set_state_typeno(type_, i, type_of_slot(slot));
    }
  }

  void declare_steps() {
    const Network& network = model_.system().network();
    lts_type_set_edge_label_count(type_, 3);
    const auto label = [&](int number, const char* name,
                           std::vector<std::string> values) {
      lts_type_set_edge_label_name(type_, number, name);
      lts_type_set_edge_label_typeno(type_, number,
                                     type_of_names(name, std::move(values)));
    };
    label(0, LTSMIN_EDGE_TYPE_ACTION_PREFIX, action_names(network));
    label(1, "node", mover_names(network));
    label(2, "progress", {"no", "yes"});
  }

  void declare_labels() {
    const std::size_t guards = guard_count(model_);
    const auto count = static_cast<int>(label_count(model_));
    lts_type_set_state_label_count(type_, count);
    const int truth = type("truth", LTStypeBool);
    const int guard = type(LTSMIN_LABEL_TYPE_GUARD_PREFIX, LTStypeTrilean);
    for (int i = 0; i < count; ++i) {
      const auto number = static_cast<std::size_t>(i);
      const std::string name =
          number < guards
              ? LTSMIN_LABEL_TYPE_GUARD_PREFIX "_" + std::to_string(i)
              : model_.labels()[number - guards].name;
      lts_type_set_state_label_name(type_, i, name.c_str());
      lts_type_set_state_label_typeno(type_, i,
                                      number < guards ? guard : truth);
    }
  }

  model_t self_;
  const PinsModel& model_;
  lts_type_t type_;
  bool tells_names_ = false;
  std::map<std::vector<std::string>, int> types_;  // by the names of values
  std::vector<std::pair<int, std::vector<std::string>>> named_;
};

// A matrix whose entries are what is_set(row, column) says. LTSmin owns it.
template <class IsSet>
matrix_t* matrix(std::size_t rows, std::size_t columns, IsSet is_set) {
  auto* made = static_cast<matrix_t*>(std::malloc(sizeof(matrix_t)));
  if (made == nullptr) throw std::bad_alloc();
  dm_create(made, static_cast<int>(rows), static_cast<int>(columns));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      if (is_set(static_cast<std::uint32_t>(row),
                 static_cast<std::uint32_t>(column))) {
        dm_set(made, static_cast<int>(row), static_cast<int>(column));
      }
    }
  }
  return made;
}

void tell_dependencies(model_t self, const PinsModel& model) {
  const Groups& groups = model.groups();
  const auto of_slots = [&](SlotSet GroupSlots::*which) {
    return matrix(groups.size(), model.slots().size(),
                  [&](std::uint32_t group, std::uint32_t slot) {
                    return (groups.slots(group).*which)[slot];
                  });
  };
  GBsetDMInfo(self, matrix(groups.size(), model.slots().size(),
                           [&](std::uint32_t group, std::uint32_t slot) {
                             const GroupSlots& of = groups.slots(group);
                             return of.reads[slot] || of.may_write[slot];
                           }));
  GBsetDMInfoRead(self, of_slots(&GroupSlots::reads));
  GBsetDMInfoMayWrite(self, of_slots(&GroupSlots::may_write));
  GBsetDMInfoMustWrite(self, of_slots(&GroupSlots::must_write));
  std::vector<SlotSet> read;
  for (std::uint32_t i = 0; i < guard_count(model); ++i) {
    read.push_back(model.guards()->reads(i));
  }
  for (std::size_t i = 0; i < model.labels().size(); ++i) {
    read.push_back(model.slots_of_label(i));
  }
  GBsetStateLabelInfo(self, matrix(read.size(), model.slots().size(),
                                   [&](std::uint32_t row, std::uint32_t slot) {
                                     return read[row][slot];
                                   }));
}

// Room for a number of integers behind a count, as LTSmin has its lists.
template <class List>
List* list_of(std::size_t count) {
  void* room = std::calloc(1, sizeof(List) + count * sizeof(int));
  if (room == nullptr) throw std::bad_alloc();
  auto* list = static_cast<List*>(room);
  list->count = static_cast<int>(count);
  return list;
}

void tell_label_groups(model_t self, const PinsModel& model) {
  const auto tell = [&](sl_group_enum_t group, std::size_t count) {
    auto* list = list_of<sl_group_t>(count);
    for (std::size_t i = 0; i < count; ++i) {
      list->sl_idx[i] = static_cast<int>(i);
    }
    GBsetStateLabelGroupInfo(self, group, list);
  };
  tell(GB_SL_ALL, label_count(model));
  if (model.guards() != nullptr) tell(GB_SL_GUARDS, guard_count(model));
}

// What partial-order reduction asks for. A label of a rule counts as a guard
// that any step may change that writes what it reads.
void tell_guards(model_t self, const PinsModel& model) {
  const Guards& guards = *model.guards();
  const Groups& groups = model.groups();
  const auto first_rule = static_cast<std::uint32_t>(guards.size());
  auto** of_groups =
      static_cast<guard_t**>(std::calloc(groups.size(), sizeof(guard_t*)));
  if (of_groups == nullptr) throw std::bad_alloc();
  for (std::uint32_t group = 0; group < groups.size(); ++group) {
    const auto needed = guards.of(group);
    of_groups[group] = list_of<guard_t>(needed.size());
    for (std::size_t i = 0; i < needed.size(); ++i) {
      of_groups[group]->guard[i] = static_cast<int>(needed[i]);
    }
  }
  GBsetGuardsInfo(self, of_groups);
  const std::size_t labels = label_count(model);
  const auto changes = [&](bool (Guards::*may)(std::uint32_t, std::uint32_t)
                               const) {
    return matrix(labels, groups.size(),
                  [&, may](std::uint32_t label, std::uint32_t group) {
                    return label < first_rule
                               ? (guards.*may)(label, group)
                               : groups.slots(group).may_write.intersects(
                                     model.slots_of_label(label - first_rule));
                  });
  };
  GBsetGuardNESInfo(self, changes(&Guards::may_enable));
  GBsetGuardNDSInfo(self, changes(&Guards::may_disable));
  GBsetGuardCoEnabledInfo(
      self, matrix(labels, labels, [&](std::uint32_t one, std::uint32_t other) {
        return one >= first_rule || other >= first_rule ||
               guards.may_coincide(one, other);
      }));
  GBsetDoNotAccordInfo(self,
                       matrix(groups.size(), groups.size(),
                              [&](std::uint32_t one, std::uint32_t other) {
                                return !guards.accord(one, other);
                              }));
}

void tell_model(model_t self, const PinsModel& model) {
  GBsetContext(self, const_cast<PinsModel*>(&model));
  Declaration(self, model).declare();
  std::vector<int> initial = model.initial();
  GBsetInitialState(self, initial.data());
  GBsetNextStateAll(self, all_steps);
  GBsetNextStateLong(self, steps_of_group);
  GBsetStateLabelLong(self, label_of);
  GBsetStateLabelsAll(self, all_labels);
  GBsetStateLabelsGroup(self, labels_of_group);
  GBsetGroupsOfEdge(self, groups_of_edge);
  tell_dependencies(self, model);
  tell_label_groups(self, model);
  if (model.guards() != nullptr) tell_guards(self, model);
}

// The model lives as long as the program that asked for it.
bool loads(model_t self, const char* file) {
  try {
    auto model = load_model(file, words_of_environment());
    if (!model) return false;
    tell_model(self, *model.release());
    return true;
  } catch (const std::bad_alloc&) {
    complain("BT9001", "out of memory");
  } catch (const std::exception& fault) {
    complain("BT9002", std::string("internal error: ") + fault.what());
  }
  return false;
}

void load(model_t self, const char* file) {
  if (!loads(self, file)) ltsmin_abort(LTSMIN_EXIT_FAILURE);
}

}  // namespace
}  // namespace btcheck

extern "C" {
char pins_plugin_name[] = "btcheck";
struct loader_record pins_loaders[] = {{"btf", btcheck::load},
                                       {"xml", btcheck::load},
                                       {"btpins", btcheck::load},
                                       {nullptr, nullptr}};
}
