// SPDX-License-Identifier: MIT
//
// What a call is asked for, set by names: for C, and for requests in JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "btcheck/check.hpp"

namespace btcheck::v1 {

// All that the names of `btcheck_set` in btcheck/check.h stand for.
struct Fields {
  Request request;
  Plan plan;
  std::string settings;  // the name of a btcheck.toml; "": as files lie
};

// Throws std::invalid_argument where there is no such name or the value does
// not fit it; then nothing is changed.
void set_field(std::string_view name, const std::string& value, Fields& to);

// Whether each call adds one.
bool is_list_field(std::string_view name);

std::vector<std::string> field_names();

}  // namespace btcheck::v1
