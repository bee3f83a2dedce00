// SPDX-License-Identifier: MIT
//
// The door for C: every function catches all that is thrown.
#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/fields.hpp"
#include "btcheck/check.h"
#include "btcheck/check.hpp"
#include "text/json.hpp"

namespace v1 = btcheck::v1;

struct btcheck_text {
  std::optional<std::string> text;
  bool has_failed = false;
};

struct btcheck_request {
  v1::Fields fields;
  mutable v1::Files files;  // its questions change nothing
  btcheck_source source = nullptr;
  void* source_context = nullptr;
  btcheck_source packages = nullptr;
  void* packages_context = nullptr;
  btcheck_source trees = nullptr;
  void* trees_context = nullptr;
  btcheck_monitor monitor = nullptr;
  void* monitor_context = nullptr;
  std::atomic<bool> is_cancelled = false;
  std::string error;
};

// What a report is told as.
enum class Form : std::uint8_t { Json, Sarif, Itf, Runs, Page };

struct btcheck_report {
  v1::Outcome outcome = v1::Outcome::BadInput;
  std::string error;
  // Made when they are asked for: a run may be long. A page has a name.
  std::function<std::string(Form, const std::string&)> make;
  mutable std::map<std::pair<Form, std::string>, std::string> made;
  mutable std::mutex making;
};

namespace btcheck::v1 {
namespace {

class CSources final : public Sources {
 public:
  explicit CSources(const btcheck_request& request) : request_(request) {}

  std::optional<std::string> text(const std::string& name) override {
    auto known = request_.files.text(name);
    return known ? known : told(request_.source, request_.source_context, name);
  }
  std::vector<std::string> files() override { return request_.files.files(); }
  std::string package(const std::string& name) override {
    const std::string known = request_.files.package(name);
    if (!known.empty()) return known;
    return told(request_.packages, request_.packages_context, name)
        .value_or("");
  }
  std::string file_with_tree(const std::string& id) override {
    return told(request_.trees, request_.trees_context, id).value_or("");
  }
  std::optional<NamedText> settings(const std::string& tree) override {
    const std::string& name = request_.fields.settings;
    if (name.empty()) return request_.files.settings(tree);
    auto found = text(name);
    if (!found) {
      throw std::invalid_argument(
          fmt::format("btcheck: there are no settings `{}`", name));
    }
    return NamedText{name, std::move(*found)};
  }

 private:
  static std::optional<std::string> told(btcheck_source source, void* context,
                                         const std::string& name) {
    if (source == nullptr) return std::nullopt;
    btcheck_text asked;
    const int is_there = source(context, name.c_str(), &asked);
    if (asked.has_failed) throw std::bad_alloc();
    return is_there != 0 ? std::move(asked.text) : std::nullopt;
  }

  const btcheck_request& request_;
};

class CMonitor final : public Monitor {
 public:
  explicit CMonitor(const btcheck_request& request) : request_(request) {}

  bool goes_on(const Progress& progress) override {
    return !request_.is_cancelled &&
           (request_.monitor == nullptr ||
            request_.monitor(request_.monitor_context, progress.states,
                             progress.transitions, progress.seconds) != 0);
  }

 private:
  const btcheck_request& request_;
};

// --- What is set -----------------------------------------------------------

// Does it, or says why not.
int changed(btcheck_request* request,
            const std::function<void(btcheck_request&)>& change) noexcept {
  if (request == nullptr) return -1;
  try {
    request->error.clear();
    change(*request);
    return 0;
  } catch (const std::exception& fault) {
    try {
      request->error = fault.what();
    } catch (...) {
    }
  } catch (...) {
  }
  return -1;
}

std::string given(const char* text) {
  if (text == nullptr) throw std::invalid_argument("a text is missing");
  return text;
}

// --- What is called --------------------------------------------------------

void tell_error(Outcome outcome, const std::string& error,
                btcheck_report& report) {
  report.outcome = outcome;
  report.error = error;
  report.made[{Form::Json, {}}] =
      Json{{"schema", "btcheck-error/1"}, {"error", error}}.text();
}

void tell(const std::function<void(btcheck_report&)>& make,
          btcheck_report& report) {
  try {
    make(report);
  } catch (const std::invalid_argument& fault) {
    tell_error(Outcome::BadInput, fault.what(), report);
  } catch (const std::bad_alloc&) {
    tell_error(Outcome::Internal, "out of memory", report);
  } catch (const std::exception& fault) {
    tell_error(Outcome::Internal, fault.what(), report);
  }
}

// What `make` makes of it, or why it could not.
btcheck_report* answered(
    const std::function<void(btcheck_report&)>& make) noexcept {
  try {
    auto report = std::make_unique<btcheck_report>();
    tell(make, *report);
    return report.release();
  } catch (...) {
    return nullptr;
  }
}

std::string form_of(const Report& report, Form form, const std::string& name) {
  if (form == Form::Json) return report.json();
  if (form == Form::Sarif) return report.sarif();
  if (form == Form::Runs) return report.runs_json();
  return form == Form::Page ? report.html(name) : std::string();
}
std::string form_of(const Simulation& run, Form form, const std::string&) {
  if (form == Form::Json) return run.json();
  if (form == Form::Itf) return run.itf();
  return form == Form::Page ? run.html() : std::string();
}
std::string form_of(const Description& tree, Form form, const std::string&) {
  return form == Form::Json ? tree.json() : std::string();
}

// `ask` is one of the calls of btcheck/check.hpp.
template <class Ask>
btcheck_report* asked(const btcheck_request* request, Ask ask) noexcept {
  if (request == nullptr) return nullptr;
  return answered([&](btcheck_report& report) {
    CSources sources(*request);
    CMonitor monitor(*request);
    auto answer = ask(request->fields.request, sources, &monitor);
    report.outcome = answer.outcome;
    report.make = [kept = std::move(answer)](Form form, const auto& name) {
      return form_of(kept, form, name);
    };
  });
}

const char* made(const btcheck_report* report, Form form,
                 const char* name = "") noexcept {
  if (report == nullptr || name == nullptr) return "";
  try {
    const std::lock_guard<std::mutex> lock(report->making);
    const std::pair<Form, std::string> key(form, name);
    auto found = report->made.find(key);
    if (found == report->made.end()) {
      std::string text =
          report->make ? report->make(form, key.second) : std::string();
      found = report->made.emplace(key, std::move(text)).first;
    }
    return found->second.c_str();
  } catch (...) {
    return "";
  }
}

}  // namespace
}  // namespace btcheck::v1

extern "C" {

const char* btcheck_version(void) { return v1::version().data(); }

btcheck_request* btcheck_request_new(void) {
  try {
    return new btcheck_request();
  } catch (...) {
    return nullptr;
  }
}

void btcheck_request_free(btcheck_request* request) { delete request; }

int btcheck_set(btcheck_request* request, const char* name, const char* value) {
  return v1::changed(request, [&](btcheck_request& to) {
    v1::set_field(v1::given(name), v1::given(value), to.fields);
  });
}

int btcheck_add_file(btcheck_request* request, const char* name,
                     const char* bytes, size_t length) {
  return v1::changed(request, [&](btcheck_request& to) {
    if (bytes == nullptr && length > 0) v1::given(bytes);
    to.files.add(v1::given(name), std::string(length > 0 ? bytes : "", length));
  });
}

int btcheck_add_package(btcheck_request* request, const char* name,
                        const char* folder) {
  return v1::changed(request, [&](btcheck_request& to) {
    to.files.add_package(v1::given(name), v1::given(folder));
  });
}

void btcheck_text_set(btcheck_text* to, const char* bytes, size_t length) {
  if (to == nullptr) return;
  try {
    to->text.emplace(length > 0 && bytes != nullptr ? bytes : "",
                     bytes != nullptr ? length : 0);
  } catch (...) {
    to->has_failed = true;
  }
}

void btcheck_set_source(btcheck_request* request, btcheck_source source,
                        void* context) {
  if (request == nullptr) return;
  request->source = source;
  request->source_context = context;
}

void btcheck_set_packages(btcheck_request* request, btcheck_source packages,
                          void* context) {
  if (request == nullptr) return;
  request->packages = packages;
  request->packages_context = context;
}

void btcheck_set_trees(btcheck_request* request, btcheck_source trees,
                       void* context) {
  if (request == nullptr) return;
  request->trees = trees;
  request->trees_context = context;
}

void btcheck_set_monitor(btcheck_request* request, btcheck_monitor monitor,
                         void* context) {
  if (request == nullptr) return;
  request->monitor = monitor;
  request->monitor_context = context;
}

void btcheck_cancel(btcheck_request* request) {
  if (request != nullptr) request->is_cancelled = true;
}

const char* btcheck_request_error(const btcheck_request* request) {
  return request == nullptr ? "there is no request" : request->error.c_str();
}

btcheck_report* btcheck_check(const btcheck_request* request) {
  return v1::asked(request, v1::check);
}

btcheck_report* btcheck_lint(const btcheck_request* request) {
  return v1::asked(request, v1::lint);
}

btcheck_report* btcheck_describe(const btcheck_request* request) {
  return v1::asked(request, v1::describe);
}

btcheck_report* btcheck_simulate(const btcheck_request* request) {
  return v1::asked(request, [&](const v1::Request& of, v1::Sources& sources,
                                v1::Monitor* monitor) {
    return v1::simulate(of, request->fields.plan, sources, monitor);
  });
}

btcheck_report* btcheck_explain(const char* code) {
  if (code == nullptr || !v1::explain(code)) return nullptr;
  return v1::answered([&](btcheck_report& report) {
    const auto explained = v1::explain(code);
    report.outcome = v1::Outcome::Met;
    report.made[{Form::Json, {}}] = explained->json();
  });
}

void btcheck_report_free(btcheck_report* report) { delete report; }

int btcheck_report_outcome(const btcheck_report* report) {
  return report == nullptr ? BTCHECK_BAD_INPUT
                           : static_cast<int>(report->outcome);
}

const char* btcheck_report_json(const btcheck_report* report) {
  return v1::made(report, Form::Json);
}

const char* btcheck_report_sarif(const btcheck_report* report) {
  return v1::made(report, Form::Sarif);
}

const char* btcheck_report_itf(const btcheck_report* report) {
  return v1::made(report, Form::Itf);
}

const char* btcheck_report_runs(const btcheck_report* report) {
  return v1::made(report, Form::Runs);
}

const char* btcheck_report_html(const btcheck_report* report,
                                const char* name) {
  return v1::made(report, Form::Page, name);
}

const char* btcheck_report_error(const btcheck_report* report) {
  return report == nullptr ? "there is no report" : report->error.c_str();
}

}  // extern "C"
