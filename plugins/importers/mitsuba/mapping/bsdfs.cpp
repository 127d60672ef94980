#include "bsdfs.h"

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

using Mapper = ConfigNode (*)(Part&);

const std::map<std::string_view, Mapper>& mappers() {
  static const std::map<std::string_view, Mapper> all{
      {"diffuse", map_diffuse},
      {"roughdiffuse", map_rough_diffuse},
      {"difftrans", map_diffuse_transmitter},
      {"conductor", map_conductor},
      {"roughconductor", map_rough_conductor},
      {"dielectric", map_dielectric},
      {"thindielectric", map_thin_dielectric},
      {"roughdielectric", map_rough_dielectric},
      {"plastic", map_plastic},
      {"roughplastic", map_rough_plastic},
      {"phong", map_phong},
      {"ward", map_ward},
      {"principled", map_principled},
      {"principledthin", map_principled_thin},
      {"null", map_null},
      {"twosided", map_two_sided},
      {"mask", map_mask},
      {"blendbsdf", map_blend},
      {"mixturebsdf", map_mixture},
      {"bump", map_bump},
      {"bumpmap", map_bump},
      {"normalmap", map_normal_map},
      {"coating", map_coating},
      {"roughcoating", map_coating},
      {"hk", map_without_counterpart},
      {"irawan", map_without_counterpart},
      {"measured", map_without_counterpart},
      {"measured_polarized", map_without_counterpart},
      {"circular", map_without_counterpart},
      {"polarizer", map_without_counterpart},
      {"pplastic", map_without_counterpart},
      {"retarder", map_without_counterpart}};
  return all;
}

}  // namespace

ConfigNode map_bsdf(SceneMap& scene, const Object& bsdf, UvSense sense, const Location& where) {
  const auto make = [&] {
    return map_part(scene, bsdf, sense, "bsdf", mapper_of(mappers(), bsdf));
  };
  if (bsdf.id.empty()) return make();
  return text_node(scene.name_in(scene.materials(), bsdf, sense, make), where);
}

std::vector<ConfigNode> nested_bsdfs(Part& part, std::size_t least, std::size_t most) {
  const std::vector<const Object*> nested = part.children("bsdf");
  if (nested.size() < least || nested.size() > most) {
    const std::string expected =
        least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
    throw InputError(part.where(), fmt::format("{}: expected {} nested bsdf, found {}",
                                               describe(part.object()), expected, nested.size()));
  }
  std::vector<ConfigNode> nodes;
  for (const Object* bsdf : nested) {
    nodes.push_back(map_bsdf(part.map(), *bsdf, part.sense(), bsdf->where));
  }
  return nodes;
}

}  // namespace pharos::mitsuba
