// A verdict in a few lines of text.
#pragma once

#include "hexwright/quality/judge.h"

#include "console.h"

namespace hexwright::cli {

void print_verdict(const Verdict& verdict, Console& console);

}  // namespace hexwright::cli
