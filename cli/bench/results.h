// A result folder: one record per model, the lines of all of them, and the report.
//
//   OUT/records/NAME.json       one per model, rewritten after each part of its evaluation
//   OUT/pictures/NAME.PART.png
//   OUT/pages/NAME.html         the final mesh, to look into
//   OUT/results.jsonl           one line per model
//   OUT/report.html
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace hexwright::cli {

using Json = nlohmann::ordered_json;

/// A model to evaluate.
struct BenchModel {
  std::filesystem::path file;
  std::string name;  ///< path within the corpus, with '/'
  std::string key;   ///< of the file's content and what else results depend on
};

/// The surfaces of a folder, recursively, sorted by name. `fingerprint` goes into the keys.
std::vector<BenchModel> find_models(const std::filesystem::path& folder,
                                    const std::string& fingerprint);

/// Of the file's content, 16 hexadecimal digits. Throws Error{CannotOpen}.
std::string file_hash(const std::filesystem::path& file);

std::filesystem::path record_file(const std::filesystem::path& out, const std::string& name);
std::filesystem::path picture_file(const std::filesystem::path& out, const std::string& name,
                                   const std::string& part);
std::filesystem::path page_file(const std::filesystem::path& out, const std::string& name);

/// A record whose evaluation goes on; anything else in "status" is final.
inline constexpr const char* kRunning = "running";

/// The record of a model; null when there is none, it cannot be parsed or its key differs.
Json load_record(const std::filesystem::path& out, const BenchModel& model);
bool is_finished(const Json& record);

/// Writes the record, making its folder.
void save_record(const std::filesystem::path& out, const std::string& name, const Json& record);

/// The records of a results.jsonl, or of the folder that holds it. Throws Error{CannotOpen,
/// BadFile} naming the line.
std::vector<Json> load_results(const std::filesystem::path& folder_or_file);
void save_results(const std::filesystem::path& out, const std::vector<Json>& records);

}  // namespace hexwright::cli
