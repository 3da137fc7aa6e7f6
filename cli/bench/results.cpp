#include "bench/results.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <unistd.h>

#include "hexwright/base/error.h"
#include "hexwright/io/atomic_file.h"

#include "options.h"

namespace hexwright::cli {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSurfaceExtensions = {".obj", ".off", ".stl", ".ply"};

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(ErrorCode::CannotOpen, "cannot be read", file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Empty when it cannot be read.
std::string read_if_possible(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// FNV-1a, 64 bits.
std::uint64_t hash(std::string_view text, std::uint64_t state = 0xcbf29ce484222325u) {
  for (const char c : text) state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return state;
}

/// Folders that cannot be searched are entries of their own: their records say so.
bool is_entry(const fs::directory_entry& entry) {
  if (has_extension(entry.path().string(), kSurfaceExtensions)) return true;
  std::error_code ignored;
  return entry.is_directory(ignored) && access(entry.path().c_str(), R_OK | X_OK) != 0;
}

/// Whatever cannot be read has the key of nothing; devices and pipes are not waited for.
std::string read_if_regular(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? read_if_possible(file) : "";
}

/// Names too long for a file with extensions behind them are cut, and told apart by their hash.
std::string to_file_name(const fs::path& name) {
  constexpr std::size_t kLongest = 200, kKept = 160;  // bytes; file systems allow 255
  const std::string text = name.string();
  if (text.size() <= kLongest) return text;
  std::size_t cut = kKept;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0) == 0x80) --cut;  // UTF-8
  return fmt::format("{}-{:016x}", text.substr(0, cut), hash(text));
}

/// The path within a result folder that stands for a model's name.
fs::path to_result_path(const std::string& name) {
  fs::path path;
  for (const fs::path& part : fs::path(name)) path /= to_file_name(part);
  return path;
}

}  // namespace

std::string file_hash(const fs::path& file) {
  return fmt::format("{:016x}", hash(read_text(file)));
}

std::vector<BenchModel> find_models(const fs::path& folder, const std::string& fingerprint) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(ErrorCode::CannotOpen, "is not a folder of models", folder.string());
  std::vector<BenchModel> models;
  const auto options = fs::directory_options::skip_permission_denied;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, options)) {
    if (!is_entry(entry)) continue;
    const std::uint64_t key = hash(read_if_regular(entry.path()), hash(fingerprint));
    models.push_back({entry.path(), entry.path().lexically_relative(folder).generic_string(),
                      fmt::format("{:016x}", key)});
  }
  std::sort(models.begin(), models.end(),
            [](const BenchModel& a, const BenchModel& b) { return a.name < b.name; });
  return models;
}

fs::path record_file(const fs::path& out, const std::string& name) {
  fs::path file = out / "records" / to_result_path(name);
  return file += ".json";
}

fs::path picture_file(const fs::path& out, const std::string& name, const std::string& part) {
  fs::path file = out / "pictures" / to_result_path(name);
  return file += "." + part + ".png";
}

fs::path page_file(const fs::path& out, const std::string& name) {
  fs::path file = out / "pages" / to_result_path(name);
  return file += ".html";
}

Json load_record(const fs::path& out, const BenchModel& model) {
  Json record = Json::parse(read_if_regular(record_file(out, model.name)), nullptr, false);
  if (!record.is_object() || record.value("key", "") != model.key) return {};
  return record;
}

bool is_finished(const Json& record) {
  return record.is_object() && record.value("status", kRunning) != kRunning;
}

void save_record(const fs::path& out, const std::string& name, const Json& record) {
  const fs::path file = record_file(out, name);
  fs::create_directories(file.parent_path());
  write_file_atomically(file, record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<Json> load_results(const fs::path& folder_or_file) {
  const fs::path file =
      fs::is_directory(folder_or_file) ? folder_or_file / "results.jsonl" : folder_or_file;
  std::ifstream stream(file);
  if (!stream)
    throw Error(ErrorCode::CannotOpen, "cannot be read; give a result folder of 'hexwright bench'",
                file.string());
  std::vector<Json> records;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.empty()) continue;
    Json record = Json::parse(line, nullptr, false);
    if (!record.is_object() || !record.contains("model"))
      throw Error(ErrorCode::BadFile, "is not a record of 'hexwright bench'",
                  fmt::format("{}:{}", file.string(), number));
    records.push_back(std::move(record));
  }
  return records;
}

void save_results(const fs::path& out, const std::vector<Json>& records) {
  std::string lines;
  for (const Json& record : records)
    lines += record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  write_file_atomically(out / "results.jsonl", lines);
}

}  // namespace hexwright::cli
