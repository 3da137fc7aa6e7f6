#include "bench/runner.h"

#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <list>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "bench/child_process.h"

namespace hexwright::cli {
namespace {

namespace fs = std::filesystem;

struct Job {
  const BenchModel* model;
  fs::path log;  ///< what the process printed
  std::unique_ptr<ChildProcess> process;
  bool timed_out = false;
};

Job start_job(const BenchModel& model, const RunnerOptions& options) {
  Job job{&model, record_file(options.out, model.name).string() + ".log", nullptr, false};
  fs::create_directories(job.log.parent_path());
  std::vector<std::string> arguments = {"bench-one",
                                        model.file.string(),
                                        "--out",
                                        options.out.string(),
                                        "--name",
                                        model.name,
                                        "--key",
                                        model.key,
                                        "--memory",
                                        fmt::to_string(options.memory_per_job),
                                        "--parent",
                                        fmt::to_string(own_process()),
                                        "--quiet",
                                        "--threads",
                                        fmt::to_string(options.threads_per_job)};
  for (std::string& argument : to_arguments(options.bench))
    arguments.push_back(std::move(argument));
  // A record of other options must not pass for a part of this run's.
  fs::remove(record_file(options.out, model.name));
  job.process = std::make_unique<ChildProcess>(options.executable, arguments, job.log);
  return job;
}

/// The last line a process printed; says why it ended when it did so on its own.
std::string last_line(const fs::path& log) {
  std::ifstream stream(log);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  return last;
}

/// The record the process left, completed by how it ended.
Json finish_job(Job& job, const RunnerOptions& options) {
  Json record = load_record(options.out, *job.model);
  if (!record.is_object())
    record = {{"schema", 1}, {"model", job.model->name}, {"key", job.model->key}};
  if (!is_finished(record)) {
    if (job.timed_out) {
      record["status"] = "timeout";
      record["message"] = fmt::format("not done after {} s", options.seconds_per_model);
    } else {
      const std::string line = last_line(job.log);
      record["status"] = "crashed";
      record["message"] = job.process->describe_end() + (line.empty() ? "" : ": " + line);
    }
  }
  record["wall_seconds"] = job.process->seconds();
  save_record(options.out, job.model->name, record);
  fs::remove(job.log);
  return record;
}

/// The record of a model whose process could not be started: the rest goes on.
Json refuse_job(const BenchModel& model, const RunnerOptions& options, const std::string& why) {
  const Json record = {{"schema", 1},         {"model", model.name}, {"key", model.key},
                       {"status", "crashed"}, {"message", why},      {"wall_seconds", 0.0}};
  save_record(options.out, model.name, record);
  return record;
}

}  // namespace

void run_models(const std::vector<BenchModel>& models, const RunnerOptions& options,
                const Context& context, const std::function<void(const Json&)>& on_finished) {
  std::list<Job> running;
  std::size_t next = 0;
  while (next < models.size() || !running.empty()) {
    context.check_cancelled();  // the processes end with the list
    while (next < models.size() && running.size() < static_cast<std::size_t>(options.jobs)) {
      const BenchModel& model = models[next++];
      try {
        running.push_back(start_job(model, options));
      } catch (const std::exception& e) {
        on_finished(refuse_job(model, options, e.what()));
      }
    }
    for (auto job = running.begin(); job != running.end();) {
      const bool has_ended = job->process->has_ended();
      if (!has_ended && job->process->seconds() > options.seconds_per_model) {
        job->process->kill();
        job->timed_out = true;
      } else if (!has_ended) {
        ++job;
        continue;
      }
      on_finished(finish_job(*job, options));
      job = running.erase(job);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace hexwright::cli
