#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/conformance/check.h>
#include <pharos/scene/scene.h>

/// The scenes in which emitters are tested.
namespace pharos::conformance {

/// An emitter in a small scene.
struct Site {
  std::string name;
  std::unique_ptr<const Scene> scene;
  const Light* light = nullptr;
  Point3 center;
  float radius = 1;
  std::vector<Point3> references;
  LightSample lit;  ///< a sample that sees the light from some point; pdf 0 if none was found

  bool is_lit() const { return lit.pdf > 0; }
};

inline constexpr const char* kNeverLit = "no lit point was found";

/// Places the emitter on a square and on a ball, or alone if it needs no shape.
std::vector<Site> sites_of(const Ref<Emitter>& emitter);
std::string where(const Site& site, Point3 from);

/// Tests rays that leave the light. `carried` is the check `emission`, which compares the power of
/// such rays through a disk with the power found by light samples. `density` is the check
/// `emission_density`.
void check_emission(const Site& site, std::uint64_t seed, Check& carried, Check& density);

}  // namespace pharos::conformance
