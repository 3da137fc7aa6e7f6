// Any text as the value of any option of any stage. The first two bytes choose the table and the
// row.
#include <cstdint>
#include <string>

#include "hexwright/pipeline/option_table.h"

#include "fuzz_file.h"

namespace {

using namespace hexwright;

/// Values of these may name files, which are read at once.
bool reads_files(const NamedOption& option) {
  return option.name == "sizes" || option.name == "refine";
}

/// Refused values are BadArgument and leave the options as they were.
void set_option(const OptionTable& table, std::uint8_t row, const std::string& text) {
  fuzz::require(!table.empty(), "a table has no rows");
  const NamedOption& option = table[row % table.size()];
  fuzz::require(find_option(table, option.name) != nullptr, "a row is not found by its name");
  try {
    option.set(text);
  } catch (const Error& error) {
    const bool is_of_file =
        error.code() == ErrorCode::CannotOpen || error.code() == ErrorCode::BadFile;
    fuzz::require(error.code() == ErrorCode::BadArgument || (reads_files(option) && is_of_file),
                  error.what());
  }
}

template <class Options>
void set_option_of(std::uint8_t row, const std::string& text) {
  Options options;
  set_option(make_option_table(options), row, text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  constexpr void (*kTables[])(std::uint8_t, const std::string&) = {
      set_option_of<MeshOptions>,       set_option_of<CompleteOptions>,
      set_option_of<DualStageOptions>,  set_option_of<FitStageOptions>,
      set_option_of<ImproveOptions>,    set_option_of<PolycubeOptions>,
      set_option_of<FeatureOptions>,    set_option_of<EvaluateOptions>,
      set_option_of<PolycubeMapOptions>};
  kTables[data[0] % std::size(kTables)](
      data[1], std::string(reinterpret_cast<const char*>(data) + 2, size - 2));
  return 0;
}
