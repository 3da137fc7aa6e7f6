// The component's one function. Whatever goes wrong in OpenCASCADE, which throws exceptions of its
// own and may raise signals on damaged geometry, becomes an Error.
#define OCC_CONVERT_SIGNALS
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

#include "cad/occt/build_model.h"
#include "cad/occt/document.h"
#include "cad/occt/solids.h"

namespace hexwright {
namespace cad {
namespace {

/// While it lives, memory faults in OpenCASCADE become exceptions; then the caller's handlers are
/// back.
class SignalGuard {
 public:
  SignalGuard() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], nullptr, &before_[k]);
    OSD::SetSignal(OSD_SignalMode_Set, false);
  }
  ~SignalGuard() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], &before_[k], nullptr);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  static constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGILL,  SIGFPE, SIGSYS,
                                          SIGHUP,  SIGINT, SIGQUIT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> before_;
};

CadModel read(const std::filesystem::path& path, const CadReadOptions& options) {
  Document document = read_document(path);
  std::vector<std::string> notes;
  const std::vector<TopoDS_Shape> solids = find_solids(document, notes);
  CadModel model = build_model(document, solids, options);
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
