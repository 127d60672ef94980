#include "integrators.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

/// The longest path in Pharos, for paths that end only by Russian roulette.
constexpr std::int64_t kLongestPath = 32767;
constexpr std::int64_t kDefaultRouletteDepth = 5;

/// Integrators that are path tracers of emitted light, like `path`.
constexpr std::array<std::string_view, 6> kPathTracers{"path",    "direct",         "prb",
                                                       "volpath", "volpath_simple", "volpathmis"};
/// Integrators whose image is not the image of all light.
constexpr std::array<std::string_view, 4> kOtherImages{"ao", "depth", "field", "aov"};
/// Integrators that contain another integrator.
constexpr std::array<std::string_view, 5> kWrappers{"adaptive", "aov", "irrcache", "moment",
                                                    "multichannel"};

template <class Names>
bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void set_integer(Part& part, ConfigNode& node, const char* key, std::int64_t value) {
  node.set(key, text_node(fmt::format("{}", value), part.where()), part.where());
}

void set_depth(Part& part, ConfigNode& node) {
  const std::int64_t stated = part.object().type == "direct" ? 2 : -1;
  const std::int64_t depth = part.integer("max_depth").value_or(stated);
  const bool is_unlimited = depth < 0;
  const std::int64_t longest = is_unlimited ? kLongestPath : depth;
  set_integer(part, node, "max_depth", longest);
  const std::int64_t roulette = part.integer("rr_depth").value_or(kDefaultRouletteDepth);
  if (roulette >= longest && !is_unlimited) return;  // paths end before Russian roulette begins
  ConfigNode termination = part.node("throughput");
  set_integer(part, termination, "depth", std::clamp<std::int64_t>(roulette, 0, kLongestPath));
  node.set("termination", std::move(termination), part.where());
}

ConfigNode map_path(Part& part) {
  ConfigNode node = part.node("path");
  set_depth(part, node);
  part.ignore({"strict_normals", "samples_per_pass", "block_size", "timeout"});
  if (part.flag("hide_emitters", false)) {
    part.note(fmt::format("integrator {}: emitters are seen although 'hide_emitters' is set",
                          part.object().type));
  }
  return node;
}

/// Marks the settings of unused methods as read.
void skip_the_rest(Part& part) {
  for (const Property& p : part.object().properties) part.take(p.name);
}

}  // namespace

ConfigNode map_integrator(SceneMap& scene, const Object& integrator) {
  return map_part(scene, integrator, UvSense::same, "integrator", [&](Part& part) {
    const std::string& type = integrator.type;
    const std::vector<const Object*> nested = part.children("integrator");
    if (has(kOtherImages, type)) {
      part.note(fmt::format("integrator {}: replaced by path, which shows light", type));
    } else if (!has(kPathTracers, type) && !has(kWrappers, type)) {
      part.note(fmt::format("integrator {}: replaced by path", type));
    }
    if (has(kWrappers, type) && !nested.empty()) {
      skip_the_rest(part);
      return map_integrator(scene, *nested.front());
    }
    ConfigNode node = map_path(part);
    if (!has(kPathTracers, type)) skip_the_rest(part);
    if (type == "direct") part.ignore({"shading_samples", "emitter_samples", "bsdf_samples"});
    return node;
  });
}

ConfigNode default_integrator(SceneMap& scene, const Location& where) {
  const bool is_old = scene.document().dialect == Dialect::mitsuba_0;
  const Object standard{.tag = "integrator", .type = is_old ? "direct" : "path", .where = where};
  Part part(scene, standard);
  return map_path(part);
}

}  // namespace pharos::mitsuba
