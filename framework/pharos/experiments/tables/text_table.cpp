#include <algorithm>

#include <fmt/format.h>

#include <pharos/experiments/tables/text_table.h>

namespace pharos {

std::string aligned(const std::vector<TextRow>& rows) {
  std::string text;
  for (const TextRow& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      std::size_t width = 0;
      for (const TextRow& other : rows) {
        width = std::max(width, fmt::formatted_size("{}", other[c]));
      }
      line += fmt::format("{:<{}}  ", row[c], width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace pharos
