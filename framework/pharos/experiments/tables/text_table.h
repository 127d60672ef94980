#pragma once

#include <string>
#include <vector>

namespace pharos {

/// A line of a table, one text a column.
using TextRow = std::vector<std::string>;

/// Rows of one length as lines of columns, two spaces apart, without spaces at their ends.
std::string aligned(const std::vector<TextRow>& rows);

}  // namespace pharos
