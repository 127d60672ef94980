#include "media.h"

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

using Checker = void (*)(Part&);

void check_isotropic(Part&) {}

void check_henyey_greenstein(Part& part) {
  const double g = part.number("g", 0.8);
  if (!(g > -1 && g < 1)) throw InputError(part.where(), "phase hg: 'g' must be above -1, below 1");
}

void check_other_phase(Part& part) {
  for (const Property& p : part.object().properties) part.take(p.name);
}

void check_phase(SceneMap& scene, const Object& phase) {
  static const std::map<std::string_view, Checker> all{
      {"blendphase", check_other_phase}, {"hg", check_henyey_greenstein},
      {"isotropic", check_isotropic},    {"kkay", check_other_phase},
      {"microflake", check_other_phase}, {"mixturephase", check_other_phase},
      {"rayleigh", check_other_phase},   {"sggx", check_other_phase},
      {"tabphase", check_other_phase}};
  const Checker check = mapper_of(all, phase);
  SceneMap::Entry entry(scene, phase);
  Part part(scene, phase);
  check(part);
  part.finish();
}

void check_coefficient(Part& part, const char* name) {
  const std::optional<Spectrum> value = part.color(name);
  if (!value) return;
  const Rgb c = value->value;
  if (c.r >= 0 && c.g >= 0 && c.b >= 0) return;
  throw InputError(part.object().find(name)->where, fmt::format("'{}' must be at least 0", name));
}

void check_homogeneous(Part& part) {
  for (const char* name : {"sigma_s", "sigma_a", "sigma_t", "albedo"}) {
    check_coefficient(part, name);
  }
  if (!(part.number("scale", 1) >= 0)) {
    throw InputError(part.where(), "medium homogeneous: 'scale' must be at least 0");
  }
  part.ignore(
      {"material", "sample_emitters", "has_spectral_extinction", "strategy", "sampling_weight"});
  if (const Object* phase = part.child("phase")) check_phase(part.map(), *phase);
}

void check_heterogeneous(Part& part) {
  for (const Property& p : part.object().properties) part.take(p.name);
}

}  // namespace

std::optional<ConfigNode> map_medium(SceneMap& scene, const Object& medium) {
  static const std::map<std::string_view, Checker> all{{"heterogeneous", check_heterogeneous},
                                                       {"homogeneous", check_homogeneous}};
  const Checker check = mapper_of(all, medium);
  SceneMap::Entry entry(scene, medium);
  Part part(scene, medium);
  check(part);
  part.finish();
  scene.note(medium.where, fmt::format("medium {}: left out, light passes freely", medium.type));
  return std::nullopt;
}

}  // namespace pharos::mitsuba
