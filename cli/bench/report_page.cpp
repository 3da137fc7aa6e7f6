#include "bench/report_page.h"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <utility>

#include "hexwright/io/base64.h"
#include "hexwright/version.h"

#include "bench/page_files.h"
#include "bench/summary.h"

namespace hexwright::cli {
namespace {

namespace fs = std::filesystem;

/// A picture as a data URL; empty when the file is gone.
std::string inline_picture(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return "data:image/png;base64," + to_base64(bytes);
}

/// JSON inside a script element must not close it.
std::string for_script(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

/// Puts each text in place of its mark, in the order of the marks on the page: one pass, so that
/// marks inside the texts are not looked at.
std::string fill(std::string_view page,
                 std::initializer_list<std::pair<std::string_view, std::string_view>> parts) {
  std::string filled;
  for (const auto& [mark, text] : parts) {
    const std::size_t at = page.find(mark);
    if (at == std::string_view::npos) continue;
    filled.append(page.substr(0, at)).append(text);
    page.remove_prefix(at + mark.size());
  }
  return filled.append(page);
}

}  // namespace

std::string make_report_page(const std::vector<Json>& records, const fs::path& out) {
  Json models = Json::array();
  for (Json record : records) {
    if (record.contains("pictures"))
      for (auto& picture : record["pictures"])
        picture = inline_picture(out / picture.get<std::string>());
    models.push_back(std::move(record));
  }
  const Json data = {
      {"version", HEXWRIGHT_VERSION}, {"summary", summarize(records)}, {"models", models}};
  return fill(kReportHtml, {{"/*STYLE*/", kReportCss},
                            {"/*LIBRARY*/", kChartJs},
                            {"/*DATA*/", for_script(data)},
                            {"/*SCRIPT*/", kReportJs}});
}

}  // namespace hexwright::cli
