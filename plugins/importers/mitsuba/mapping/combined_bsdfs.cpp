// Materials made of other materials.
#include <cstdlib>

#include <fmt/core.h>

#include "bsdfs.h"
#include "textures.h"

namespace pharos::mitsuba {
namespace {

constexpr double kRoundingOfWeights = 1e-6;
constexpr std::size_t kMostParts = 32;  // each is nested in the previous one

/// Reads the numbers of a text such as "0.3, 0.7". A single number may also be a property of type
/// number.
std::vector<double> read_weights(Part& part) {
  const Property* p = part.object().find("weights");
  if (p == nullptr) throw InputError(part.where(), "bsdf mixturebsdf: 'weights' is missing");
  if (!std::holds_alternative<std::string>(p->value)) return {*part.number("weights")};
  const std::string text = *part.text("weights");
  std::vector<double> weights;
  const char* at = text.c_str();
  while (true) {
    while (*at == ' ' || *at == ',' || *at == ';' || *at == '\t' || *at == '\n') ++at;
    if (*at == '\0') break;
    char* end = nullptr;
    const double weight = std::strtod(at, &end);
    if (end == at || !(weight >= 0 && weight <= 1e9)) {
      throw InputError(p->where, "'weights' must be numbers of at least 0 with commas between");
    }
    weights.push_back(weight);
    at = end;
  }
  if (weights.empty() || weights.size() > kMostParts) {
    throw InputError(p->where, fmt::format("'weights' must be 1 to {} numbers", kMostParts));
  }
  return weights;
}

ConfigNode black(const Location& where) {
  ConfigNode node = ConfigNode::mapping(where);
  node.set("type", text_node("diffuse", where), where);
  node.set("reflectance", number_node(0, where), where);
  return node;
}

/// Nests the blends, starting with the last part. The weight of each blend is the share of the
/// parts after it in the sum of its own part and those after it.
ConfigNode chain_of_blends(Part& part, const std::vector<double>& weights,
                           std::vector<ConfigNode> parts) {
  ConfigNode mixed = std::move(parts.back());
  double rest = weights.back();
  for (std::size_t i = weights.size() - 1; i-- > 0;) {
    const double total = rest + weights[i];
    ConfigNode node = part.node("blend");
    node.set("first", std::move(parts[i]), part.where());
    node.set("second", std::move(mixed), part.where());
    node.set("weight", number_node(total > 0 ? rest / total : 1, part.where()), part.where());
    mixed = std::move(node);
    rest = total;
  }
  return mixed;
}

/// Returns the texture that modifies normals.
ConfigNode bending_texture(Part& part) {
  const std::vector<const Object*> all = part.children("texture");
  if (all.size() != 1) {
    throw InputError(part.where(), fmt::format("{}: expected 1 texture, found {}",
                                               describe(part.object()), all.size()));
  }
  return map_texture(part.map(), *all[0], part.sense(), all[0]->where);
}

}  // namespace

ConfigNode map_two_sided(Part& part) {
  std::vector<ConfigNode> sides = nested_bsdfs(part, 1, 2);
  ConfigNode node = part.node("two_sided");
  node.set("bsdf", std::move(sides[0]), part.where());
  if (sides.size() == 2) node.set("back", std::move(sides[1]), part.where());
  return node;
}

ConfigNode map_mask(Part& part) {
  ConfigNode node = part.node("mask");
  node.set("opacity", part.texture_or("opacity", 0.5), part.where());
  node.set("bsdf", std::move(nested_bsdfs(part, 1, 1)[0]), part.where());
  return node;
}

ConfigNode map_blend(Part& part) {
  std::vector<ConfigNode> both = nested_bsdfs(part, 2, 2);
  ConfigNode node = part.node("blend");
  node.set("first", std::move(both[0]), part.where());
  node.set("second", std::move(both[1]), part.where());
  node.set("weight", part.texture_or("weight", 0.5), part.where());
  return node;
}

/// If the weights sum to less than 1, the remainder is black. If they sum to more, they are
/// normalized.
ConfigNode map_mixture(Part& part) {
  const std::vector<double> weights = read_weights(part);
  std::vector<ConfigNode> parts = nested_bsdfs(part, weights.size(), weights.size());
  double missing = 1;
  for (const double w : weights) missing -= w;
  if (missing <= kRoundingOfWeights) return chain_of_blends(part, weights, std::move(parts));
  std::vector<double> all = weights;
  all.push_back(missing);
  parts.push_back(black(part.where()));
  return chain_of_blends(part, all, std::move(parts));
}

ConfigNode map_bump(Part& part) {
  ConfigNode node = part.node("bump_map");
  node.set("texture", bending_texture(part), part.where());
  node.set("height", part.number_or("scale", 1), part.where());
  node.set("bsdf", std::move(nested_bsdfs(part, 1, 1)[0]), part.where());
  return node;
}

ConfigNode map_normal_map(Part& part) {
  ConfigNode node = part.node("normal_map");
  node.set("texture", bending_texture(part), part.where());
  node.set("bsdf", std::move(nested_bsdfs(part, 1, 1)[0]), part.where());
  return node;
}

}  // namespace pharos::mitsuba
