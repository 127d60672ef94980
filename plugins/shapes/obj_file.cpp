#include "obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "text_scanner.h"
#include "triangle_shape.h"
#include "vertex_table.h"

namespace pharos {
namespace {

constexpr std::uint32_t kAbsent = ~std::uint32_t{0};

/// The indices of a face corner: a position, texture coordinates and a normal, or kAbsent.
using Corner = std::array<std::uint32_t, 3>;
enum CornerPart : std::size_t { kPosition, kUv, kNormal };
constexpr std::array<std::string_view, 3> kPartNames{"vertex", "texture coordinate", "normal"};

/// Statements that do not define a surface.
constexpr std::array<std::string_view, 13> kPassedOver{
    "l",      "p",   "s",     "mg",       "usemtl",   "mtllib",     "usemap",
    "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj",
};

/// Reads the file. Positions, texture coordinates and normals are numbered through the whole file,
/// in all parts.
class ObjReader {
 public:
  explicit ObjReader(const MeshSource& source)
      : part_(source.part), scanner_(source.bytes, source.path.string()) {}

  TriangleMesh read() {
    begin_part();
    do {
      read_statement();
    } while (scanner_.next_line());
    check_part(part_, names_);
    return has_uvs_ || has_normals_ ? with_combined_vertices() : with_positions_alone();
  }

 private:
  void read_statement() {
    const std::string_view keyword = scanner_.word();
    if (keyword.empty()) return;
    if (keyword == "v") {
      add(positions_, scanner_.vec3());
    } else if (keyword == "vt") {
      add(uvs_, read_uv());
    } else if (keyword == "vn") {
      add(normals_, scanner_.vec3());
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "o") {
      object_ = scanner_.rest();
      groups_.clear();
      begin_part();
    } else if (keyword == "g") {
      groups_.clear();
      while (scanner_.has_word()) groups_.emplace_back(scanner_.word());
      begin_part();
    } else {
      check_passed_over(keyword);
    }
  }

  template <class T>
  void add(std::vector<T>& all, T one) {
    if (all.size() == kAbsent) scanner_.fail("there are too many of these");
    all.push_back(one);
  }

  Vec2 read_uv() {
    const float u = scanner_.number();
    return {u, scanner_.has_word() ? scanner_.number() : 0};
  }

  void begin_part() {
    wanted_ = part_.empty() || object_ == part_ ||
              std::find(groups_.begin(), groups_.end(), part_) != groups_.end();
    named_ = false;
  }

  void check_passed_over(std::string_view keyword) {
    if (std::find(kPassedOver.begin(), kPassedOver.end(), keyword) == kPassedOver.end()) {
      scanner_.fail(fmt::format("'{}' is no statement that can be read", one_line(keyword, 40)));
    }
  }

  void read_face() {
    Corner first{}, last{};
    for (std::size_t i = 0; scanner_.has_word(); ++i) {
      const Corner corner = read_corner(scanner_.word());
      if (i == 0) first = corner;
      if (i >= 2) add_triangle({first, last, corner});
      last = corner;
    }
  }

  void add_triangle(const std::array<Corner, 3>& corners) {
    if (!named_) name_part();
    if (!wanted_) return;
    triangles_.push_back(corners);
    check_triangle_count(static_cast<double>(triangles_.size()), "it");
    for (const Corner& corner : corners) {
      has_uvs_ = has_uvs_ || corner[kUv] != kAbsent;
      has_normals_ = has_normals_ || corner[kNormal] != kAbsent;
    }
  }

  /// Records the names of the current part. Only parts with triangles have names.
  void name_part() {
    named_ = true;
    if (!object_.empty()) names_.insert(object_);
    names_.insert(groups_.begin(), groups_.end());
  }

  /// Reads "5", "5/6", "5//7" or "5/6/7".
  Corner read_corner(std::string_view word) {
    Corner corner{kAbsent, kAbsent, kAbsent};
    const std::array<std::size_t, 3> counts{positions_.size(), uvs_.size(), normals_.size()};
    std::string_view left = word;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const std::string_view number = left.substr(0, left.find('/'));
      if (!number.empty()) corner[i] = read_index(number, counts[i], kPartNames[i]);
      left.remove_prefix(std::min(number.size() + 1, left.size()));
    }
    if (!left.empty() || corner[kPosition] == kAbsent) {
      scanner_.fail(fmt::format("'{}' is no corner of a face", one_line(word, 40)));
    }
    return corner;
  }

  /// Reads an index. Indices begin at 1; negative ones count back from the last entry.
  std::uint32_t read_index(std::string_view number, std::size_t count, std::string_view kind) {
    std::int64_t index = 0;
    const char* const end = number.data() + number.size();
    const auto [rest, error] = std::from_chars(number.data(), end, index);
    if (error != std::errc{} || rest != end) {
      scanner_.fail(fmt::format("'{}' is not a whole number", one_line(number, 40)));
    }
    const auto most = static_cast<std::int64_t>(count);
    if (index == 0 || index > most || index < -most) {
      scanner_.fail(fmt::format("there is no {} {}; it is preceded by {}", kind, index, count));
    }
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : most + index);
  }

  TriangleMesh with_positions_alone() {
    TriangleMesh mesh;
    mesh.positions = std::move(positions_);
    mesh.triangles.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_) {
      mesh.triangles.push_back({a[kPosition], b[kPosition], c[kPosition]});
    }
    return mesh;
  }

  /// Builds the mesh with one vertex for every combination of indices in the corners.
  TriangleMesh with_combined_vertices() const {
    TriangleMesh mesh;
    mesh.triangles.reserve(triangles_.size());
    VertexTable<3> table(3 * triangles_.size());
    for (const auto& [a, b, c] : triangles_) {
      const std::uint32_t first = table.number_of(a), second = table.number_of(b);
      mesh.triangles.push_back({first, second, table.number_of(c)});
    }
    for (const Corner& corner : table.vertices()) append(corner, mesh);
    return mesh;
  }

  void append(const Corner& corner, TriangleMesh& mesh) const {
    mesh.positions.push_back(positions_[corner[kPosition]]);
    if (has_uvs_) mesh.uvs.push_back(corner[kUv] == kAbsent ? Vec2{} : uvs_[corner[kUv]]);
    if (has_normals_) {
      mesh.normals.push_back(corner[kNormal] == kAbsent ? Vec3{} : normals_[corner[kNormal]]);
    }
  }

  const std::string& part_;
  TextScanner scanner_;
  std::vector<Point3> positions_;
  std::vector<Vec2> uvs_;
  std::vector<Vec3> normals_;
  std::string object_;               ///< to which the current faces belong
  std::vector<std::string> groups_;  ///< likewise
  bool wanted_ = true;               ///< whether they belong to the part
  bool named_ = false;               ///< whether they are in `names_`
  std::set<std::string> names_;
  std::vector<std::array<Corner, 3>> triangles_;
  bool has_uvs_ = false, has_normals_ = false;
};

}  // namespace

TriangleMesh read_obj(const MeshSource& source) {
  return ObjReader(source).read();
}

}  // namespace pharos
