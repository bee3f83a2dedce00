// SPDX-License-Identifier: MIT
//
// What btcheck/check.hpp offers, for C and for languages that call C: texts go
// in, JSON comes out. C99 and the standard headers alone.
//
//     btcheck_request *request = btcheck_request_new();
//     btcheck_add_file(request, "patrol.xml", text, strlen(text));
//     btcheck_set(request, "tree", "patrol.xml");
//     btcheck_report *report = btcheck_check(request);
//     puts(btcheck_report_json(report));
//     btcheck_report_free(report);
//     btcheck_request_free(request);
//
// Texts are UTF-8 and end with a zero byte, but for those with a length. What
// is given is copied before a function returns. What is returned belongs to the
// request or the report it is asked of, until that is freed; requests and
// reports belong to the caller. NULL may be freed.
//
// Threads share nothing: calls may go on at once, also with one request, as long
// as nobody changes or frees it meanwhile and its callbacks allow it. Reports
// are never changed, and may be read by several threads.
//
// No function throws, prints or ends the process. Names are added, and none
// changes its meaning.
#ifndef BTCHECK_CHECK_H
#define BTCHECK_CHECK_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct btcheck_request btcheck_request;
typedef struct btcheck_report btcheck_report;
typedef struct btcheck_text btcheck_text;

// As the exit codes of the program.
enum btcheck_outcome {
  BTCHECK_MET = 0,        // every rule is as expected; without rules: no fault
  BTCHECK_MISSED = 1,     // some rule is not, or a finding is an error
  BTCHECK_BAD_INPUT = 2,  // nothing was checked
  BTCHECK_UNDECIDED = 3,  // a limit was reached, and nothing is violated
  BTCHECK_INTERNAL = 4    // a mistake of btcheck, or no memory
};

// "0.1.0".
const char *btcheck_version(void);

// --- What goes in ---------------------------------------------------------

// NULL where there is no memory.
btcheck_request *btcheck_request_new(void);
void btcheck_request_free(btcheck_request *request);

// Sets what `name` stands for; 0, or -1 where there is no such name or the value
// does not fit, and btcheck_request_error() says why.
//
//   tree               the name of a file: XML, or .btf
//   profile            "nav2-jazzy"; "": as the files say
//   main_tree          its ID; "": as the file says
//   ticks              where time passes: root, leaves, nodes, none; "": root,
//                      or as the rules say
//   settings           the name of a btcheck.toml; "": of the files that were
//                      added, the one in the folder of the tree or above it
//   tick_milliseconds  what one tick of the root takes; "0": as the settings
//                      say, else 100
//   loops, wake_ups, tries_repairs   "true" or "false"
//   one_program        "true"; "false": models in files with trees of their own
//                      do not count, as for a command given one file of a folder
//   directory          absolute: where names that are not absolute begin
//   threads            a number from 1 on
//   seconds            for the whole call, "2.5"; "0": no limit
//   states, bytes      the most that a search may store; "0": no limit
//   seed, script, run_ticks   for btcheck_simulate: a number; the name of a file
//                      of answers; how many ticks of the tree
//
// Of these there may be several, and each call adds one:
//
//   rules, leaves, models   names of files
//   typed_rules             "never dock.failure"
int btcheck_set(btcheck_request *request, const char *name, const char *value);

// A file of the program, by the name that others ask for it. 0, or -1.
int btcheck_add_file(btcheck_request *request, const char *name,
                     const char *bytes, size_t length);
// The share folder of a ROS package, for <include ros_pkg="...">. 0, or -1.
int btcheck_add_package(btcheck_request *request, const char *name,
                        const char *folder);

// Asked for a file that was not added, by the thread that called: returns 1, and
// has given its text to btcheck_text_set, or 0 where there is none.
typedef int (*btcheck_source)(void *context, const char *name,
                              btcheck_text *to);
void btcheck_text_set(btcheck_text *to, const char *bytes, size_t length);
void btcheck_set_source(btcheck_request *request, btcheck_source source,
                        void *context);

// In the same way: asked for the share folder of a ROS package that was not
// added, and for the name of the file that has a tree which no added file has.
void btcheck_set_packages(btcheck_request *request, btcheck_source packages,
                          void *context);
void btcheck_set_trees(btcheck_request *request, btcheck_source trees,
                       void *context);

// Asked some hundred times a second, by any thread of the call, how the search
// goes: 0 ends the call within a tenth of a second, and what is known then is in
// the report. `seconds` is since the call.
typedef int (*btcheck_monitor)(void *context, uint64_t states,
                               uint64_t transitions, double seconds);
void btcheck_set_monitor(btcheck_request *request, btcheck_monitor monitor,
                         void *context);

// Ends the calls that go on with the request as a monitor does, from any thread,
// and all later ones as soon as they begin.
void btcheck_cancel(btcheck_request *request);

// Why the last btcheck_set, btcheck_add_file or btcheck_add_package has failed;
// "" where it has not.
const char *btcheck_request_error(const btcheck_request *request);

// --- Calls, and what comes out ----------------------------------------------

// Each returns a report, whatever is wrong with the tree; NULL for no request,
// and where there is no memory.
btcheck_report *btcheck_check(const btcheck_request *request);
btcheck_report *btcheck_lint(const btcheck_request *request);
btcheck_report *btcheck_describe(const btcheck_request *request);
btcheck_report *btcheck_simulate(const btcheck_request *request);
// What a code means; NULL for one that does not exist.
btcheck_report *btcheck_explain(const char *code);

void btcheck_report_free(btcheck_report *report);

// An enum btcheck_outcome. BTCHECK_BAD_INPUT for no report.
int btcheck_report_outcome(const btcheck_report *report);
// Of a check and lint what `btcheck --format json` prints; else one object, with
// the names of btcheck/check.hpp.
const char *btcheck_report_json(const btcheck_report *report);
// Of a check and lint SARIF; of a simulation the run as ITF JSON; else "".
const char *btcheck_report_sarif(const btcheck_report *report);
const char *btcheck_report_itf(const btcheck_report *report);
// Of a check all its runs by their names, one object; else "".
const char *btcheck_report_runs(const btcheck_report *report);
// The page that shows the run of that name, one file for any browser; of a
// simulation its run by whatever name. "" for a name that no run has.
const char *btcheck_report_html(const btcheck_report *report, const char *name);
// What is wrong with the request itself, a profile that does not exist for
// instance, or with btcheck; "" for nothing. Mistakes in trees stand in the JSON.
const char *btcheck_report_error(const btcheck_report *report);

#ifdef __cplusplus
}
#endif

#endif
