#include "serialized_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "inflater.h"
#include "triangle_shape.h"

// A file consists of its meshes and a list of the places where each mesh begins [bytes from the
// start of the file], in 64 bits (version 3: 32). The number of meshes follows at the very end, in
// 32 bits. A mesh consists of two 16-bit numbers, 0x041c and the version, and a zlib stream of
//
//     flags                                     32 bits
//     name                                      version 4: up to a zero byte
//     numbers of vertices and triangles         64 bits each
//     positions, normals, uvs, colors           of all vertices, the last three if flagged
//     three vertices of every triangle          32 bits each
//
// All numbers are little-endian. The manual of Mitsuba 0.6 describes the format under `serialized`.
namespace pharos {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint16_t kMagic = 0x041c;
constexpr std::size_t kHeaderSize = 2 * sizeof(std::uint16_t);
constexpr std::size_t kLongestName = 4096;
/// Three vertices per triangle, for the largest number of triangles of a shape.
constexpr std::uint64_t kMostVertices = 600'000'000;

enum Flag : std::uint32_t {
  kHasNormals = 0x0001,
  kHasUvs = 0x0002,
  kHasColors = 0x0008,
  kFaceNormals = 0x0010,
  kDouble = 0x2000
};

template <class T>
T number_at(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// Returns the same triangles without normals. They share no vertices, so that no normals are
/// smoothed across them.
TriangleMesh faceted(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    result.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t vertex : triangle) {
      result.positions.push_back(mesh.positions[vertex]);
      if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[vertex]);
    }
  }
  return result;
}

/// Reads the fields of one mesh in order.
class MeshReader {
 public:
  /// Starts with the mesh at the front of `bytes` and reads up to its name.
  explicit MeshReader(std::string_view bytes) : stream_(bytes.substr(kHeaderSize)) {
    flags_ = number<std::uint32_t>("flags");
    if (number_at<std::uint16_t>(bytes, sizeof(kMagic)) > 3) read_name();
  }

  const std::string& name() const { return name_; }

  /// Reads the rest. May be called once.
  TriangleMesh read() {
    const auto vertices = number<std::uint64_t>("number of vertices");
    const auto triangles = number<std::uint64_t>("number of triangles");
    check_triangle_count(static_cast<double>(triangles), "it");
    if (vertices > kMostVertices) {
      throw InputError(fmt::format("it would have {} vertices; at most {} are possible", vertices,
                                   kMostVertices));
    }
    TriangleMesh mesh;
    read_vectors(mesh.positions, vertices, "position");
    if (has(kHasNormals)) read_vectors(mesh.normals, vertices, "normal");
    if (has(kHasUvs)) read_uvs(mesh.uvs, vertices);
    if (has(kHasColors)) read_floats<3>(vertices, "color", [](const auto&) {});
    read_triangles(mesh, triangles);
    char beyond;
    stream_.read(&beyond, 1);  // reaches the end of the stream, which holds the checksum
    return has(kFaceNormals) ? faceted(mesh) : mesh;
  }

 private:
  bool has(Flag flag) const { return (flags_ & flag) != 0; }

  template <class T>
  T number(const char* what) {
    T value;
    if (!stream_.read(reinterpret_cast<char*>(&value), sizeof(T))) {
      throw InputError(fmt::format("it ends before its {}", what));
    }
    return value;
  }

  void read_name() {
    while (const char c = number<char>("name is over")) {
      name_ += c;
      if (name_.size() > kLongestName) throw InputError("its name does not end");
    }
  }

  /// Passes each of `count` items of `n` numbers to `take`, together with its index. `what` is the
  /// name of an item in messages.
  template <class T, std::size_t n, class Take>
  void read_items(std::uint64_t count, const char* what, const Take& take) {
    constexpr std::uint64_t kBlock = 1024;
    std::vector<std::array<T, n>> block(kBlock);
    for (std::uint64_t first = 0; first < count; first += kBlock) {
      const std::uint64_t size = std::min(kBlock, count - first);
      if (!stream_.read(reinterpret_cast<char*>(block.data()), size * sizeof(block[0]))) {
        throw InputError(fmt::format("it ends before its {} {}s", count, what));
      }
      for (std::uint64_t i = 0; i < size; ++i) take(first + i, block[i]);
    }
  }

  /// The same for numbers in the file's precision, converted to finite floats.
  template <std::size_t n, class Take>
  void read_floats(std::uint64_t count, const char* what, const Take& take) {
    const auto narrowed = [&](std::uint64_t index, const auto& item) {
      std::array<float, n> narrow;
      for (std::size_t i = 0; i < n; ++i) narrow[i] = static_cast<float>(item[i]);
      if (!std::all_of(narrow.begin(), narrow.end(), [](float v) { return std::isfinite(v); })) {
        throw InputError(fmt::format("{} {} is not finite", what, index));
      }
      take(narrow);
    };
    has(kDouble) ? read_items<double, n>(count, what, narrowed)
                 : read_items<float, n>(count, what, narrowed);
  }

  void read_vectors(std::vector<Vec3>& to, std::uint64_t count, const char* what) {
    read_floats<3>(count, what, [&](const auto& v) { to.push_back({v[0], v[1], v[2]}); });
  }

  void read_uvs(std::vector<Vec2>& to, std::uint64_t count) {
    // In Mitsuba v runs from the top of the image.
    read_floats<2>(count, "texture coordinate", [&](const auto& uv) {
      to.push_back({uv[0], 1 - uv[1]});
    });
  }

  void read_triangles(TriangleMesh& mesh, std::uint64_t count) {
    read_items<std::uint32_t, 3>(count, "triangle", [&](std::uint64_t index, const auto& triangle) {
      const std::uint32_t largest = *std::max_element(triangle.begin(), triangle.end());
      if (largest >= mesh.positions.size()) {
        throw InputError(
            fmt::format("triangle {} names vertex {}, which is missing", index, largest));
      }
      mesh.triangles.push_back(triangle);
    });
  }

  Inflater stream_;
  std::uint32_t flags_ = 0;
  std::string name_;
};

/// Returns the version of the mesh at the front of `bytes`. Throws InputError if there is none.
std::uint16_t version_of(std::string_view bytes) {
  if (bytes.size() < kHeaderSize || number_at<std::uint16_t>(bytes, 0) != kMagic) {
    throw InputError("it does not begin like a 'serialized' file of Mitsuba");
  }
  const auto version = number_at<std::uint16_t>(bytes, sizeof(kMagic));
  if (version != 3 && version != 4) {
    throw InputError(fmt::format("it is of version {}; known are 3 and 4", version));
  }
  return version;
}

/// Returns the bytes of each mesh of a file, which begin at the places that the file lists.
std::vector<std::string_view> meshes_of(std::string_view bytes, std::uint16_t version) {
  const std::size_t entry = version == 3 ? sizeof(std::uint32_t) : sizeof(std::uint64_t);
  const std::size_t most = (bytes.size() - sizeof(std::uint32_t)) / entry;
  const std::size_t count = number_at<std::uint32_t>(bytes, bytes.size() - sizeof(std::uint32_t));
  if (count == 0 || count > most) {
    throw InputError(fmt::format("its list of meshes is cut off or names {} of them", count));
  }
  const std::size_t list = bytes.size() - sizeof(std::uint32_t) - count * entry;
  const auto begin = [&](std::size_t i) -> std::uint64_t {
    if (i == count) return list;
    return entry == sizeof(std::uint32_t) ? number_at<std::uint32_t>(bytes, list + i * entry)
                                          : number_at<std::uint64_t>(bytes, list + i * entry);
  };
  std::vector<std::string_view> meshes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t from = begin(i), to = begin(i + 1);
    // The places must increase, so that no byte is unpacked twice.
    if (from >= to || to > list) {
      throw InputError(fmt::format("mesh {} lies from byte {} to {} of {}", i, from, to, list));
    }
    meshes.push_back(bytes.substr(from, to - from));
  }
  return meshes;
}

/// Adds `more` to `mesh`. If only one of them has normals or texture coordinates, the other gets
/// zeros.
void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const std::size_t before = mesh.positions.size(), after = before + more.positions.size();
  check_triangle_count(static_cast<double>(mesh.triangles.size() + more.triangles.size()), "it");
  if (after > kMostVertices) throw InputError("there are too many vertices in all");
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  const auto join = [&](auto& to, const auto& from) {
    if (to.empty() && from.empty()) return;
    to.resize(before);
    to.insert(to.end(), from.begin(), from.end());
    to.resize(after);
  };
  join(mesh.normals, more.normals);
  join(mesh.uvs, more.uvs);
  for (std::array<std::uint32_t, 3> triangle : more.triangles) {
    for (std::uint32_t& vertex : triangle) vertex += static_cast<std::uint32_t>(before);
    mesh.triangles.push_back(triangle);
  }
}

/// Calls `read` with the number of every requested mesh, and adds this number to its exceptions.
template <class Read>
void for_each_mesh(std::size_t count, std::optional<int> only, const Read& read) {
  for (std::size_t i = 0; i < count; ++i) {
    if (only && static_cast<std::size_t>(*only) != i) continue;
    try {
      read(i);
    } catch (const InputError& error) {
      throw InputError(fmt::format("mesh {}: {}", i, error.what()));
    }
  }
}

}  // namespace

TriangleMesh read_serialized(const MeshSource& source) {
  const std::uint16_t version = version_of(source.bytes);
  if (version == 3 && !source.part.empty()) {
    throw InputError("files of version 3 have no names; 'shape_index' chooses a mesh");
  }
  const std::vector<std::string_view> meshes = meshes_of(source.bytes, version);
  if (source.index && static_cast<std::size_t>(*source.index) >= meshes.size()) {
    throw InputError(fmt::format("there is no mesh {}: it has {}, counted from 0", *source.index,
                                 meshes.size()));
  }
  TriangleMesh result;
  std::set<std::string> names;
  for_each_mesh(meshes.size(), source.index, [&](std::size_t i) {
    version_of(meshes[i]);
    MeshReader reader(meshes[i]);
    names.insert(reader.name());
    if (source.part.empty() || reader.name() == source.part) append(result, reader.read());
  });
  check_part(source.part, names);
  return result;
}

}  // namespace pharos
