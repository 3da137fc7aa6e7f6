// The options about sizes: of the command line, of Python and of files.
#pragma once

#include "hexwright/pipeline/option_table.h"

namespace hexwright {

/// All that a file of sizes may hold.
OptionTable size_rows(SizeWishes& sizes);

/// The file itself.
NamedOption size_file_row(SizeWishes& sizes);

}  // namespace hexwright
