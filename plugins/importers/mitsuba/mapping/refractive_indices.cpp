// The materials that Mitsuba knows by name, as its manual lists them. Indices measured at the
// wavelength of sodium light are given at that wavelength.
#include "refractive_indices.h"

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

const std::map<std::string_view, double>& known_materials() {
  static const std::map<std::string_view, double> all{
      {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
      {"air", kIorOfAir},   {"carbon dioxide", 1.00045}, {"water", 1.3330},
      {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
      {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
      {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
      {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", kIorOfPolypropylene},
      {"bk7", kIorOfBk7},   {"sodium chloride", 1.544},  {"amber", 1.55},
      {"pet", 1.5750},      {"diamond", 2.419}};
  return all;
}

}  // namespace

double refractive_index(Part& part, std::string_view name, double otherwise) {
  const Property* p = part.object().find(name);
  if (p == nullptr || !std::holds_alternative<std::string>(p->value)) {
    return part.number(name, otherwise);
  }
  const std::string material = *part.text(name);
  const auto found = known_materials().find(material);
  if (found != known_materials().end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [key, ior] : known_materials()) known.emplace_back(key);
  throw InputError(p->where, fmt::format("'{}': unknown material '{}'{}; known: {}", name,
                                         one_line(material, 60), suggestion(material, known),
                                         quoted_list(known)));
}

ConfigNode relative_ior(Part& part, double inside) {
  const Property* stated = part.object().find("int_ior");
  const double interior = refractive_index(part, "int_ior", inside);
  const double exterior = refractive_index(part, "ext_ior", kIorOfAir);
  const Location& there = stated != nullptr ? stated->where : part.where();
  if (!(exterior > 0)) throw InputError(there, "'ext_ior' must be above 0");
  return number_node(interior / exterior, there);
}

}  // namespace pharos::mitsuba
