// SPDX-License-Identifier: MIT
//
// What breaks, for other programs: JSON, a sheet, fault trees, a page.
#pragma once

#include <string>
#include <string_view>

#include "report/whatif/runs.hpp"

namespace btcheck {

// What a name means never changes; new names may come. docs/whatif.md
inline constexpr std::string_view kWhatIfSchema = "btcheck-whatif/1";

// All of it, with the answers of each run. Nothing in it hangs on the machine
// or the time: it can be kept, compared, and read again (earlier.hpp).
std::string what_if_json(const WhatIfReport& report);

// A line for each single fault, in the columns of an FMEA: RFC 4180, with a
// heading.
std::string what_if_csv(const WhatIfReport& report);

// The events that must not be, and the faults and pairs that make them happen,
// in Graphviz's language and as a picture: faults of one leaf with the same
// effect are one box.
std::string fault_tree_dot(const WhatIfReport& report);
std::string fault_tree_svg(const WhatIfReport& report);

// The same in the Open-PSA Model Exchange Format, each fault a basic event,
// without probabilities.
std::string fault_tree_xml(const WhatIfReport& report);

// One file for the browser: leaves and faults as a matrix, and each run in the
// viewer. It asks nothing from anywhere.
std::string what_if_page(const WhatIfReport& report);

// The page's form, style sheet and script, compiled in from page/.
extern const std::string_view kWhatIfPage;
extern const std::string_view kWhatIfStyle;
extern const std::string_view kWhatIfScript;

}  // namespace btcheck
