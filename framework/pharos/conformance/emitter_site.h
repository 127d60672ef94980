#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/conformance/check.h>
#include <pharos/scene/scene.h>

/// Where emitters are tested.
namespace pharos::conformance {

/// An emitter as it stands in a small scene.
struct Site {
  std::string name;
  std::unique_ptr<const Scene> scene;
  const Light* light = nullptr;
  Point3 center;
  float radius = 1;
  std::vector<Point3> references;
  LightSample lit;  ///< one that sees the light, from somewhere; of pdf 0 where none was found

  bool is_lit() const { return lit.pdf > 0; }
};

inline constexpr const char* kNeverLit = "no lit point was found";

/// On a square and on a ball, or alone.
std::vector<Site> sites_of(const Ref<Emitter>& emitter);
std::string where(const Site& site, Point3 from);

/// Rays that leave the light: checks `emission` (power through a disk, of such rays and of light
/// samples) and `emission_density`.
void check_emission(const Site& site, std::uint64_t seed, Check& carried, Check& density);

}  // namespace pharos::conformance
