#include "microfacets.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <pharos/config/values.h>

namespace pharos::mitsuba {
namespace {

constexpr double kSmoothest = 1e-4, kRoughest = 1;

void set_distribution(Part& part, ConfigNode& node) {
  const std::string distribution = part.text("distribution", "beckmann");
  static const std::vector<std::string> known{"as", "beckmann", "ggx", "phong"};
  if (std::find(known.begin(), known.end(), distribution) == known.end()) {
    throw InputError(
        part.object().find("distribution")->where,
        fmt::format("unknown distribution '{}'{}; known: {}", one_line(distribution, 60),
                    suggestion(distribution, known), quoted_list(known)));
  }
  const bool is_known_here = distribution == "ggx" || distribution == "beckmann";
  // In Phong's distribution, also called `as` for Ashikhmin and Shirley, the exponent is 2 /
  // alpha^2 - 2. With this exponent it is close to Beckmann's distribution (Walter et al. 2007,
  // section 5.2).
  if (!is_known_here) {
    part.note(fmt::format("bsdf {}: distribution '{}' is replaced by Beckmann's of the same alpha",
                          part.object().type, distribution));
  }
  const Property* stated = part.object().find("distribution");
  const Location& there = stated != nullptr ? stated->where : part.where();
  node.set("distribution", text_node(is_known_here ? distribution : "beckmann", there), there);
}

double in_range(Part& part, double alpha) {
  if (!(alpha > kRoughest)) return std::max(alpha, kSmoothest);  // as in Mitsuba
  part.note(fmt::format("bsdf {}: roughness above 1 is taken as 1", part.object().type));
  return kRoughest;
}

struct Roughness {
  double u, v;
};

Roughness read_roughness(Part& part) {
  const double alpha = part.average("alpha", 0.1);
  return {in_range(part, part.average("alpha_u", alpha)),
          in_range(part, part.average("alpha_v", alpha))};
}

/// Sets `key`, located at the property `name` of the scene file if it is present.
void set_number(Part& part, ConfigNode& node, const char* key, const char* name, double value) {
  const Property* stated = part.object().find(name);
  const Location& there = stated != nullptr ? stated->where : part.where();
  node.set(key, number_node(value, there), there);
}

/// Sets the properties that do not depend on roughness.
void set_facets(Part& part, ConfigNode& node) {
  set_distribution(part, node);
  node.set("masking", text_node("separable", part.where()), part.where());
}

}  // namespace

void set_isotropic_roughness(Part& part, ConfigNode& node) {
  const Roughness alpha = read_roughness(part);
  if (alpha.u != alpha.v) {
    part.note(fmt::format("bsdf {}: 'alpha_u' and 'alpha_v' are replaced by their geometric mean",
                          part.object().type));
  }
  const double both = alpha.u == alpha.v ? alpha.u : std::sqrt(alpha.u * alpha.v);
  set_number(part, node, "alpha", "alpha", both);
  set_facets(part, node);
}

void set_roughness(Part& part, ConfigNode& node) {
  const Roughness alpha = read_roughness(part);
  set_number(part, node, "alpha", part.has("alpha_u") ? "alpha_u" : "alpha", alpha.u);
  if (alpha.u != alpha.v) set_number(part, node, "alpha_v", "alpha_v", alpha.v);
  set_facets(part, node);
}

}  // namespace pharos::mitsuba
