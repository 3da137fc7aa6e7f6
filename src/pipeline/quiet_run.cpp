#include "pipeline/quiet_run.h"

#include <string>
#include <utility>
#include <vector>

#include "hexwright/base/error.h"

namespace hexwright {

MeshResult run_quietly(MeshRun run, const MeshOptions& options, const Context& context) {
  std::vector<std::string> warnings;
  Context quiet = context;
  quiet.on_warning = [&warnings](std::string_view message) { warnings.emplace_back(message); };
  MeshResult result = run(options, quiet);
  result.warnings = std::move(warnings);
  return result;
}

std::optional<MeshResult> try_quietly(MeshRun run, const MeshOptions& options,
                                      const Context& context) {
  try {
    return run_quietly(run, options, context);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::OutOfResources) throw;
    return {};
  }
}

MeshResult say_warnings(MeshResult&& result, const Context& context) {
  for (const std::string& warning : result.warnings) context.warn(warning);
  return std::move(result);
}

}  // namespace hexwright
