#pragma once

// A stand-in for Open PGL 0.7 if the library is not installed. It is the part of the C++ interface
// that the module uses, with a model of its own, so that the module is compiled and tested
// everywhere. It behaves like the library in these respects:
// - Queries outside the bounds or in untrained cells fail and keep the previous distribution.
// - The random numbers of queries are rescaled in place.
// - Fields change in place and can be copied through files only (without times in these files).
// - One NaN makes a field useless.
//
// The model has a density (1 + a . w) / (4 pi) of directions w in each of the eight octants of the
// bounds, where a is the weighted mean of the directions of the samples there.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

struct pgl_vec3f {
  float x, y, z;
};
struct pgl_vec2f {
  float x, y;
};
using pgl_point3f = pgl_vec3f;
using pgl_point2f = pgl_vec2f;
using pgl_direction = pgl_vec3f;
struct pgl_box3f {
  pgl_point3f lower, upper;
};

enum PGL_DEVICE_TYPE { PGL_DEVICE_TYPE_CPU_4, PGL_DEVICE_TYPE_CPU_8 };
enum PGL_SPATIAL_STRUCTURE_TYPE { PGL_SPATIAL_STRUCTURE_KDTREE };
enum PGL_DIRECTIONAL_DISTRIBUTION_TYPE {
  PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM,
  PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE,
  PGL_DIRECTIONAL_DISTRIBUTION_VMM
};

struct PGLSampleData {
  enum Flags { EInsideVolume = 1, EDirectLight = 2 };
  pgl_point3f position;
  pgl_direction direction;
  float weight, pdf, distance;
  std::uint32_t flags;
};
struct PGLZeroValueSampleData {
  pgl_point3f position;
  pgl_direction direction;
  bool volume;
};

namespace openpgl::cpp {

using SampleData = PGLSampleData;
using ZeroValueSampleData = PGLZeroValueSampleData;

inline pgl_vec3f Vector3(float x, float y, float z) {
  return {x, y, z};
}
inline pgl_point3f Point3(float x, float y, float z) {
  return {x, y, z};
}
inline pgl_point2f Point2(float x, float y) {
  return {x, y};
}
inline pgl_box3f Box3(pgl_point3f lower, pgl_point3f upper) {
  return {lower, upper};
}
inline pgl_direction CompressDirection(const pgl_vec3f& direction) {
  return direction;
}

struct Device {
  explicit Device(PGL_DEVICE_TYPE, std::size_t = 0) {}
  Device(const Device&) = delete;
};

struct FieldConfig {
  FieldConfig() = default;
  FieldConfig(const FieldConfig&) = delete;
  void Init(PGL_SPATIAL_STRUCTURE_TYPE, PGL_DIRECTIONAL_DISTRIBUTION_TYPE type, bool = true,
            std::size_t = 32000) {
    multiplies_ = type != PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE;
  }
  void SetSpatialStructureArgMaxDepth(std::size_t) {}
  void SetUseKnnLookup(bool neighbors) { neighbors_ = neighbors; }

  bool multiplies_ = true, neighbors_ = true;
};

struct SampleStorage {
  SampleStorage() = default;
  SampleStorage(const SampleStorage&) = delete;
  void Reserve(const std::size_t& surface, const std::size_t& volume) {
    samples_.reserve(surface + volume);
  }
  void AddSample(const SampleData& sample) { samples_.push_back(sample); }
  void AddZeroValueSample(const ZeroValueSampleData& sample) {
    samples_.push_back({sample.position, sample.direction, 0, 1, 1, sample.volume ? 1u : 0u});
  }

  std::vector<SampleData> samples_;
};

struct Field {
  struct Cell {
    double weight = 0, x = 0, y = 0, z = 0;
  };

  Field(Device*, const FieldConfig& config)
      : multiplies_(config.multiplies_), neighbors_(config.neighbors_) {}
  Field(Device*, const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(&multiplies_), sizeof multiplies_);
    in.read(reinterpret_cast<char*>(&neighbors_), sizeof neighbors_);
    in.read(reinterpret_cast<char*>(&bounds_), sizeof bounds_);
    in.read(reinterpret_cast<char*>(&iteration_), sizeof iteration_);
    in.read(reinterpret_cast<char*>(cells_.data()), sizeof cells_);
    if (!in) throw std::runtime_error("could not load field from file!");
  }
  Field(const Field&) = delete;

  bool Store(const std::string& file) const {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&multiplies_), sizeof multiplies_);
    out.write(reinterpret_cast<const char*>(&neighbors_), sizeof neighbors_);
    out.write(reinterpret_cast<const char*>(&bounds_), sizeof bounds_);
    out.write(reinterpret_cast<const char*>(&iteration_), sizeof iteration_);
    out.write(reinterpret_cast<const char*>(cells_.data()), sizeof cells_);
    return out.good();
  }
  void SetSceneBounds(const pgl_box3f& bounds) { bounds_ = bounds; }
  pgl_box3f GetSceneBounds() const { return bounds_; }
  std::size_t GetIteration() const { return iteration_; }
  void Update(const SampleStorage& storage) {
    for (const SampleData& s : storage.samples_) {
      if (!is_inside(s.position)) continue;
      Cell& cell = cells_[index(s.position) + 8 * (s.flags & SampleData::EInsideVolume)];
      cell.weight += s.weight;
      cell.x += s.weight * s.direction.x;
      cell.y += s.weight * s.direction.y;
      cell.z += s.weight * s.direction.z;
    }
    ++iteration_;
  }

  bool is_inside(pgl_point3f p) const {
    const auto inside = [](float v, float low, float high) { return v > low && v < high; };
    return inside(p.x, bounds_.lower.x, bounds_.upper.x) &&
           inside(p.y, bounds_.lower.y, bounds_.upper.y) &&
           inside(p.z, bounds_.lower.z, bounds_.upper.z);
  }
  std::size_t index(pgl_point3f p) const {
    const auto high = [](float v, float low, float top) { return v > 0.5f * (low + top); };
    return (high(p.x, bounds_.lower.x, bounds_.upper.x) ? 1u : 0u) +
           (high(p.y, bounds_.lower.y, bounds_.upper.y) ? 2u : 0u) +
           (high(p.z, bounds_.lower.z, bounds_.upper.z) ? 4u : 0u);
  }

  bool multiplies_ = true, neighbors_ = true;
  pgl_box3f bounds_{};
  std::size_t iteration_ = 0;
  std::array<Cell, 16> cells_{};  ///< of surfaces, then of volumes
};

/// Base of both kinds of query objects.
template <std::size_t kFirstCell>
struct SamplingDistribution {
  explicit SamplingDistribution(const Field* field) : multiplies_(field->multiplies_) {}
  SamplingDistribution(const SamplingDistribution&) = delete;

  bool Init(const Field* field, const pgl_point3f& at, float& sample1D) {
    if (field->GetIteration() == 0 || !field->is_inside(at)) return false;
    std::size_t index = field->index(at);
    if (field->neighbors_) {
      // Takes the neighboring octant with a probability of 1/4.
      const bool beside = sample1D < 0.25f;
      index ^= beside ? 1u : 0u;
      sample1D = beside ? 4 * sample1D : (sample1D - 0.25f) / 0.75f;
    }
    const Field::Cell& cell = field->cells_[kFirstCell + index];
    if (!(cell.weight > 0)) return false;
    const double w = cell.weight;
    a_ = {static_cast<float>(cell.x / w), static_cast<float>(cell.y / w),
          static_cast<float>(cell.z / w)};
    return true;
  }
  pgl_vec3f Sample(const pgl_point2f& u) const {
    // The cosine c with the direction of a has the density (1 + r c) / 2; the azimuth is uniform.
    const float r = std::min(std::sqrt(a_.x * a_.x + a_.y * a_.y + a_.z * a_.z), 1.0f);
    const float c = r < 1e-3f ? 2 * u.x - 1 : (std::sqrt((1 - r) * (1 - r) + 4 * r * u.x) - 1) / r;
    const float s = std::sqrt(std::max(0.0f, 1 - c * c)), phi = 6.2831853f * u.y;
    const pgl_vec3f n = r < 1e-3f ? pgl_vec3f{0, 0, 1} : pgl_vec3f{a_.x / r, a_.y / r, a_.z / r};
    // Two unit vectors perpendicular to n and to each other (Duff et al. 2017).
    const float sign = std::copysign(1.0f, n.z), k = -1 / (sign + n.z), b = n.x * n.y * k;
    const pgl_vec3f t{1 + sign * n.x * n.x * k, sign * b, -sign * n.x};
    const pgl_vec3f v{b, sign + n.y * n.y * k, -n.y};
    const float p = s * std::cos(phi), q = s * std::sin(phi);
    return {p * t.x + q * v.x + c * n.x, p * t.y + q * v.y + c * n.y, p * t.z + q * v.z + c * n.z};
  }
  float PDF(const pgl_vec3f& w) const {
    const float length = std::sqrt(a_.x * a_.x + a_.y * a_.y + a_.z * a_.z);
    const float scale = length > 1 ? 1 / length : (length < 1e-3f ? 0 : 1);
    return std::max(0.0f, 1 + scale * (a_.x * w.x + a_.y * w.y + a_.z * w.z)) / 12.566371f;
  }

  bool multiplies_;
  pgl_vec3f a_{};
};

struct SurfaceSamplingDistribution : SamplingDistribution<0> {
  using SamplingDistribution::SamplingDistribution;
  bool SupportsApplyCosineProduct() const { return multiplies_; }
  /// This is not the product with the cosine, but it depends on the normal and stays a density.
  void ApplyCosineProduct(const pgl_vec3f& n) {
    a_ = {0.5f * (a_.x + n.x), 0.5f * (a_.y + n.y), 0.5f * (a_.z + n.z)};
  }
};
struct VolumeSamplingDistribution : SamplingDistribution<8> {
  using SamplingDistribution::SamplingDistribution;
};

}  // namespace openpgl::cpp
