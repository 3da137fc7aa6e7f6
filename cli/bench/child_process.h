// Another run of this program, watched: ended when it takes too long.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace hexwright::cli {

/// A child whose output goes to a file. Killed when the object goes out of scope.
class ChildProcess {
 public:
  /// Throws Error{OutOfResources} when the system starts no more processes.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& output);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Whether it has ended; does not wait.
  bool has_ended();
  double seconds() const;
  /// Ends it at once and waits.
  void kill();

  /// After its end: 0 and no text when it went well, else what happened ("signal 11", ...).
  bool was_ok() const { return status_ == 0; }
  bool was_signalled() const;
  std::string describe_end() const;

 private:
  int pid_ = -1;
  int status_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The running program's own file; `argv0` where the system does not tell.
std::filesystem::path own_executable(const std::string& argv0);

/// Limits this process' address space; 0 = no limit.
void limit_own_memory(std::size_t mebibytes);

/// Has the system end this process when its parent dies, where it can; at once when `parent` is
/// not its parent any more.
void end_with_parent(int parent);
/// The number of this process, for end_with_parent() in its children.
int own_process();

/// Physical memory, 0 where the system does not tell.
std::size_t physical_memory_mebibytes();

}  // namespace hexwright::cli
