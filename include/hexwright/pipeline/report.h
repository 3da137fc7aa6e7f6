// The report of a run as JSON: what `hexwright mesh --report FILE` writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hexwright/cad/cad_surface.h"
#include "hexwright/io/set_table.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/pipeline/stages.h"
#include "hexwright/polycube/polycube.h"

namespace hexwright {

/// What the caller knows and the result does not.
struct RunInfo {
  std::string input, output;  ///< paths as given
  int num_threads = 0;
  std::vector<ChangedName> changed_names = {};  ///< of sets, by the output's format
  std::optional<CadSummary> cad = {};           ///< where the input is a CAD file
};

/// Counts per level and stage, seconds, peak memory, quality, distances, features, rounds, options,
/// versions, warnings and failures; the options as they were in the end. Keys are documented in
/// docs/cli.md.
std::string report_to_json(const MeshResult& result, const RunInfo& run);

/// The options as one JSON object, as the report has them.
std::string mesh_options_to_json(const MeshOptions& options);

/// The parts of the report that the single stages write.
std::string sizing_to_json(const SizingResult& sizing);
std::string complete_to_json(const CompleteReport& complete);
std::string dual_to_json(const DualReport& dual);
std::string fit_to_json(const FitStageResult& fit);
/// A line or two for people.
std::string curving_to_text(const CurvingReport& curving);
/// Tets count from 1 in it, as in the files.
std::string polycube_to_json(const PolycubeReport& polycube);

/// A CAD file's solids, faces and edges, as JSON and for people.
std::string cad_to_json(const CadSummary& cad);
std::string cad_to_text(const CadSummary& cad);

/// Peak resident memory of this process in bytes; 0 where the system does not tell.
std::size_t peak_memory_bytes();

}  // namespace hexwright
