// Rows of option tables, by the type of what they set.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hexwright/base/function_ref.h"
#include "hexwright/pipeline/option_names.h"
#include "hexwright/pipeline/option_table.h"
#include "hexwright/pipeline/size_wishes.h"

namespace hexwright {

/// What a row says about itself.
struct RowText {
  std::string name, help;
};

/// Runs `enable` when the flag is given.
NamedOption flag_row(RowText text, std::function<void()> enable);
NamedOption flag_row(RowText text, bool& value, bool value_when_given = true);

/// Bounds are allowed values.
NamedOption whole_row(RowText text, int& value, int least, int most);
/// From 1 up.
NamedOption count_row(RowText text, std::size_t& value, std::size_t least = 1);
NamedOption number_row(RowText text, double& value, double least, double most);
/// Shown and read in degrees, kept in radians.
NamedOption degrees_row(RowText text, double& radians, double least, double most);
NamedOption share_row(RowText text, double& value);
/// A length, or a share of the diagonal; not given by default.
NamedOption length_row(RowText text, Length& value);
/// What only a reader of its own understands; `form` says how it is written.
NamedOption text_row(RowText text, std::string form,
                     std::function<void(const std::string& text)> read);
/// The name of a file that `read` reads.
NamedOption file_row(RowText text, std::string form,
                     std::function<void(const std::string& path)> read);
/// As text_row, repeated: lines of text.
NamedOption list_row(RowText text, std::string form,
                     std::function<void(const std::string& text)> read);

/// A row without its setter.
NamedOption choice_row(RowText text, const std::vector<std::string>& names,
                       const std::string& fallback);
/// The number of a name among those allowed. Throws Error{BadArgument}.
std::size_t find_choice(const std::string& text, const std::vector<std::string>& names);

/// One of a few names.
template <class Enum, std::size_t N>
NamedOption choice_row(RowText text, Enum& value, const NamedChoice<Enum> (&choices)[N]) {
  std::vector<std::string> names;
  std::vector<Enum> values;
  for (const auto& [name, choice] : choices) {
    names.push_back(name);
    values.push_back(choice);
  }
  NamedOption row = choice_row(std::move(text), names, name_of(choices, value));
  row.set = [&value, names, values](const std::string& given) {
    value = values[find_choice(given, names)];
  };
  return row;
}

}  // namespace hexwright
