// Options as Python gives them.
#pragma once

#include <map>
#include <string>

#include "hexwright/pipeline/option_table.h"

namespace hexwright::python {

/// Names with hyphens, as in the table, and values as text.
using OptionDict = std::map<std::string, std::string>;

/// Throws Error{BadArgument} naming the option whose value is not allowed. Names that the table has
/// not are the caller's to find.
void apply_options(const OptionTable& table, const OptionDict& given);

}  // namespace hexwright::python
