#include "mesh_normals.h"

#include <fstream>
#include <string>
#include <string_view>

#include <pharos/core/error.h>

namespace pharos::mitsuba {
namespace {

/// The header says what a vertex has.
bool ply_has_normals(std::istream& lines) {
  constexpr int kMostLines = 1000;
  std::string line;
  for (int i = 0; i < kMostLines && std::getline(lines, line); ++i) {
    const std::string_view text = line;
    if (text.starts_with("end_header")) return false;
    if (text.starts_with("property") && text.find(" nx") != text.npos) return true;
  }
  return true;
}

/// A face may use normals only after the file has given some.
bool obj_has_normals(std::istream& lines) {
  std::string line;
  while (std::getline(lines, line)) {
    if (line.starts_with("vn ")) return true;
  }
  return false;
}

}  // namespace

bool has_vertex_normals(const std::filesystem::path& file) {
  if (!file_problem(file).empty()) return true;
  std::ifstream lines(file, std::ios::binary);
  return file.extension() == ".ply" ? ply_has_normals(lines) : obj_has_normals(lines);
}

}  // namespace pharos::mitsuba
