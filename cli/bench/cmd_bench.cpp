// hexwright bench: the paper's evaluation over a folder of models, or what changed between two.
#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "hexwright/base/cancel.h"
#include "hexwright/io/atomic_file.h"

#include "bench/bench_options.h"
#include "bench/child_process.h"
#include "bench/compare.h"
#include "bench/report_page.h"
#include "bench/results.h"
#include "bench/runner.h"
#include "bench/summary.h"
#include "commands.h"
#include "options.h"

namespace hexwright::cli {
namespace {

namespace fs = std::filesystem;

struct BenchCommand {
  std::string models, output;
  std::vector<std::string> only, compared;
  int jobs = 0;
  std::size_t memory = 0;
  double seconds = 600;
  bool fresh = false, retry = false;
  BenchOptions options;
  CompareTolerances tolerances;
};

RunnerOptions plan(const BenchCommand& cmd, const Program& program) {
  RunnerOptions runner;
  runner.executable = own_executable(program.executable);
  runner.out = cmd.output;
  const int cores = num_threads();
  runner.jobs = cmd.jobs > 0 ? cmd.jobs : cores;
  runner.threads_per_job = std::max(1, cores / runner.jobs);
  const std::size_t memory = cmd.memory > 0 ? cmd.memory : physical_memory_mebibytes() / 4 * 3;
  runner.memory_per_job = memory / static_cast<std::size_t>(runner.jobs);
  runner.seconds_per_model = cmd.seconds;
  runner.bench = cmd.options;
  return runner;
}

/// What one line of progress says about a finished model.
std::string describe(const Json& record) {
  std::string text = record.value("status", "?");
  if (record.contains("message")) text += ": " + record["message"].get<std::string>();
  const Json::json_pointer blocks("/methods/blocks/cells"), cells("/input/cells");
  if (record.contains(blocks))
    text += fmt::format(", {} cells, blocks {}", record[cells].dump(), record[blocks].dump());
  const Json::json_pointer valid("/mesh/valid"), hexes("/mesh/hexes");
  if (record.contains(valid))
    text += fmt::format(", mesh of {} hexes {}", record[hexes].dump(),
                        record[valid].get<bool>() ? "valid" : "fails the gate");
  return fmt::format("{}, {:.1f} s", text, record.value("wall_seconds", 0.0));
}

bool needs_run(const BenchCommand& cmd, const Json& record) {
  if (cmd.fresh || !is_finished(record)) return true;
  return cmd.retry && record["status"] != "done";
}

/// Writes the lines and the report of all models that are finished; returns their records.
std::vector<Json> write_results(const BenchCommand& cmd, const std::vector<BenchModel>& models) {
  std::vector<Json> records;
  for (const BenchModel& model : models) {
    Json record = load_record(cmd.output, model);
    if (is_finished(record)) records.push_back(std::move(record));
  }
  save_results(cmd.output, records);
  write_file_atomically(fs::path(cmd.output) / "report.html",
                        make_report_page(records, cmd.output));
  return records;
}

std::vector<BenchModel> choose_models(const BenchCommand& cmd, std::vector<BenchModel> models) {
  if (!cmd.only.empty())
    std::erase_if(models, [&](const BenchModel& model) {
      return std::none_of(cmd.only.begin(), cmd.only.end(), [&](const std::string& text) {
        return model.name.find(text) != std::string::npos;
      });
    });
  if (models.empty())
    throw Error(ErrorCode::CannotOpen, "holds no OBJ, OFF, STL or PLY file to evaluate",
                cmd.models);
  return models;
}

void evaluate_folder(const BenchCommand& cmd, Program& program) {
  const Context context = program.console.start();
  const std::vector<BenchModel> all =
      find_models(cmd.models, fingerprint(cmd.options, own_executable(program.executable)));
  const std::vector<BenchModel> models = choose_models(cmd, all);
  std::error_code error;
  fs::create_directories(cmd.output, error);
  if (error) throw Error(ErrorCode::CannotOpen, "cannot be made: " + error.message(), cmd.output);

  std::vector<BenchModel> to_run;
  for (const BenchModel& model : models)
    if (needs_run(cmd, load_record(cmd.output, model))) to_run.push_back(model);
  if (to_run.size() < models.size())
    program.console.print(fmt::format("{} of {} models are done already",
                                      models.size() - to_run.size(), models.size()));
  std::size_t done = 0;
  try {
    run_models(to_run, plan(cmd, program), context, [&](const Json& record) {
      program.console.print(fmt::format("[{}/{}] {}: {}", ++done, to_run.size(),
                                        record["model"].get<std::string>(), describe(record)));
    });
  } catch (const Error&) {
    const CancelScope scope(nullptr);  // an interrupt ends the models, not their results
    write_results(cmd, all);  // what is finished is kept; the same command goes on from there
    throw;
  }
  program.console.print(summary_to_text(summarize(write_results(cmd, all))));
  program.console.print((fs::path(cmd.output) / "report.html").string());
}

void compare_folders(const BenchCommand& cmd, Program& program) {
  const std::vector<Json> before = load_results(cmd.compared[0]);
  const std::vector<Json> after = load_results(cmd.compared[1]);
  const Comparison comparison = compare_results(before, after, cmd.tolerances);
  program.console.print(comparison.text);
  for (const std::string& regression : comparison.regressions) program.console.fail(regression);
  if (comparison.regressions.empty()) program.console.print("no regression");
  program.exit_code = comparison.regressions.empty() ? Valid : FailsGate;
}

void run(const BenchCommand& cmd, Program& program) {
  if (!cmd.compared.empty()) return compare_folders(cmd, program);
  if (cmd.models.empty() || cmd.output.empty())
    throw CLI::ValidationError(
        "give a folder of models and -o for the results, or --compare and two results");
  evaluate_folder(cmd, program);
}

void add_tolerances(CLI::App& sub, CompareTolerances& t) {
  const auto add = [&](const char* name, double& value, const char* help) {
    sub.add_option(name, value, help)
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->group("What --compare lets pass");
  };
  add("--allow-count", t.count, "Cells and hexes up by this share");
  add("--allow-min-sj", t.min_sj, "Least scaled Jacobian down by this");
  add("--allow-avg-sj", t.avg_sj, "Average scaled Jacobian down by this");
  add("--allow-distance", t.distance, "Distance up by this share");
  add("--allow-features", t.features, "Share of features met down by this");
  add("--allow-time", t.time, "Time of all models up by this share; 0 = not judged");
}

}  // namespace

void add_bench_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<BenchCommand>();
  CLI::App* sub = app.add_subcommand("bench", "The paper's evaluation over a folder of models");
  sub->add_option("models", cmd->models, "Folder with OBJ, OFF, STL, PLY (searched recursively)");
  sub->add_option("-o,--output", cmd->output,
                  "Folder for results.jsonl and report.html; finished models are kept");
  sub->add_option("--compare", cmd->compared,
                  "Two result folders or results.jsonl: what changed; exit code 1 on a regression")
      ->expected(2);
  sub->add_option("--only", cmd->only, "Models whose name contains one of these");
  sub->add_option("--jobs", cmd->jobs, "Models at a time, 0 = one per core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--memory", cmd->memory,
                  "MiB for all models at work together, shared equally; 0 = 3/4 of the machine's");
  sub->add_option("--seconds", cmd->seconds, "Time limit per model")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub->add_flag("--fresh", cmd->fresh, "Evaluate all models again");
  sub->add_flag("--retry", cmd->retry, "Evaluate again those that failed or ran out of time");
  add_bench_options(*sub, cmd->options);
  add_tolerances(*sub, cmd->tolerances);
  add_console_options(*sub, program);
  sub->footer(
      "Examples:\n"
      "  hexwright bench models -o results\n"
      "  hexwright bench models -o results --jobs 2 --memory 8000 --seconds 300\n"
      "  hexwright bench --compare results-old results-new");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
