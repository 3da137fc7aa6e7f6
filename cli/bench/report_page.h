// The report of an evaluation as one HTML file that needs nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results.h"

namespace hexwright::cli {

/// Data, pictures (from the result folder), styles, script and plot library in one page.
std::string make_report_page(const std::vector<Json>& records, const std::filesystem::path& out);

}  // namespace hexwright::cli
