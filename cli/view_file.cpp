#include "view_file.h"

#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include "hexwright/io/atomic_file.h"

extern char** environ;

namespace hexwright::cli {

void write_view(const std::string& path, const HexMesh& mesh, const ViewOptions& options) {
  write_file_atomically(path, make_view_page(mesh, options));
}

void write_view(const std::string& path, const MeshResult& result, const TriMesh& surface,
                const std::string& title) {
  const SurfaceTree tree(surface);
  ViewOptions options;
  options.title = title;
  options.verdict = &result.verdict;
  options.surface = &tree;
  options.fields.push_back({"level", {result.levels.begin(), result.levels.end()}});
  if (!result.layer.empty())
    options.fields.push_back({"layer", {result.layer.begin(), result.layer.end()}});
  write_view(path, result.mesh, options);
}

bool open_in_browser(const std::string& path) {
#ifdef __APPLE__
  const char* opener = "open";
#else
  const char* opener = "xdg-open";
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return false;
#endif
  std::string file = std::filesystem::absolute(path).string(), program = opener;
  char* const arguments[] = {program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  pid_t process = 0;
  const int error = posix_spawnp(&process, opener, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0;  // it is not waited for: some openers stay as long as the browser
}

}  // namespace hexwright::cli
