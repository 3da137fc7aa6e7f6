// Runs of which only the best is kept, and what it said.
#pragma once

#include <optional>

#include "hexwright/base/function_ref.h"
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

using MeshRun = FunctionRef<MeshResult(const MeshOptions&, const Context&)>;

/// Keeps what is said in the result's warnings alone.
MeshResult run_quietly(MeshRun run, const MeshOptions& options, const Context& context);

/// The same for one try more: absent where it would take more than the budgets allow.
std::optional<MeshResult> try_quietly(MeshRun run, const MeshOptions& options,
                                      const Context& context);

/// Of the run that is kept.
MeshResult say_warnings(MeshResult&& result, const Context& context);

}  // namespace hexwright
