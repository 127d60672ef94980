#pragma once

#include <string>
#include <vector>

namespace pharos {

/// One line of a table: one text per column.
using TextRow = std::vector<std::string>;

/// Formats rows of equal length as lines with aligned columns, two spaces apart, without trailing
/// spaces.
std::string aligned(const std::vector<TextRow>& rows);

}  // namespace pharos
