// The component's one function. Whatever goes wrong in OpenCASCADE, which throws exceptions of its
// own and may raise signals on damaged geometry, becomes an Error.
#define OCC_CONVERT_SIGNALS  // NOLINT(readability-identifier-naming): its own name
#include "hexwright/cad/read_cad.h"

#include <array>
#include <csignal>
#include <mutex>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <OSD.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>

#include "hexwright/base/error.h"
#include "hexwright/geometry/similarity.h"

#include "cad/occt/build_model.h"
#include "cad/occt/document.h"
#include "cad/occt/solids.h"
#include "geometry/tree/triangle_contacts.h"

namespace hexwright {
namespace cad {
namespace {

/// While it lives, memory faults in OpenCASCADE become exceptions; requests to stop stay with the
/// caller's handlers, and in the end all signals do.
class SignalGuard {
 public:
  SignalGuard() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], nullptr, &before_[k]);
    OSD::SetSignal(OSD_SignalMode_Set, false);
    restore(kNumFaults);
  }
  ~SignalGuard() { restore(0); }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  void restore(std::size_t first) const {
    for (std::size_t k = first; k < kSignals.size(); ++k)
      sigaction(kSignals[k], &before_[k], nullptr);
  }

  static constexpr std::size_t kNumFaults = 5;
  static constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGILL,  SIGFPE, SIGSYS,
                                          SIGHUP,  SIGINT, SIGQUIT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> before_;
};

/// Crossings shallower than this, in the unit frame, are contacts or rounding.
constexpr double kCrossingDepth = 1e-6;
/// Triangles of one solid that cross, as beside tight bends, become this much finer ...
constexpr double kFiner = 0.5;
constexpr int kMostRefinements = 2;  // ... at most so often

bool crosses_itself(const CadModel& model) {
  const TriMesh unit = to_unit(model.surface, compute_unit_frame(model.surface));
  const auto is_flat = [&](TriId t) {
    const auto p = unit.corners(t);
    return norm(cross(p[1] - p[0], p[2] - p[0])) <= kCrossingDepth * kCrossingDepth;
  };
  const auto solid = [&](TriId t) { return model.faces[model.tri_to_face[t]].solid; };
  return !find_near_pairs(unit, 0, [&](TriId a, TriId b) {
            return solid(a) == solid(b) && !is_flat(a) && !is_flat(b) &&
                   find_crossing(unit.corners(a), unit.corners(b), kCrossingDepth).has_value();
          }).empty();
}

CadModel read(const std::filesystem::path& path, const CadReadOptions& given) {
  Document document = read_document(path);
  std::vector<std::string> notes;
  const std::vector<TopoDS_Shape> solids = find_solids(document, notes);
  CadReadOptions options = given;
  CadModel model = build_model(document, solids, options);
  for (int k = 0; k < kMostRefinements && crosses_itself(model); ++k) {
    options.deflection *= kFiner;
    model = build_model(document, solids, options);
  }
  if (!model.unit.empty() && model.unit != "millimetre" && model.unit != "mm")
    notes.push_back("drawn in " + model.unit + "; all lengths are millimetres");
  model.notes = std::move(notes);
  return model;
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::BadFile,
              "OpenCASCADE cannot read the shape (" + why +
                  "); repair the solid in the CAD program and export it again, or export STL");
}

CadModel read_guarded(const std::filesystem::path& path, const CadReadOptions& options) {
  const SignalGuard guard;
  try {
    OCC_CATCH_SIGNALS
    return read(path, options);
  } catch (const Standard_Failure& failure) {
    refuse(failure.DynamicType()->Name());
  }
}

/// OpenCASCADE's readers share settings and a session.
std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace
}  // namespace cad

bool can_read_cad() { return true; }

CadModel read_cad(const std::filesystem::path& path, const CadReadOptions& options) {
  const std::lock_guard lock(cad::one_at_a_time());
  Message::DefaultMessenger()->ChangePrinters().Clear();  // the library never prints
  try {
    return cad::read_guarded(path, options);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), path.string());
  }
}

}  // namespace hexwright
