#include "object_graph.h"

#include <algorithm>

#include <fmt/format.h>

namespace pharos::mitsuba {
namespace {

constexpr std::size_t kDeepestGraph = 64;
constexpr std::size_t kMostObjects = 10'000'000;

std::string called(const Object& object) {
  return object.id.empty() ? fmt::format("this {}", object.tag)
                           : fmt::format("'{}'", one_line(object.id, 60));
}

}  // namespace

void ObjectGraph::add(const Object& from, const Object& to, const Location& where) {
  references_[&from].push_back({&to, where});
}

void ObjectGraph::check(const Object& scene) {
  visit(scene, scene.where, 1);
}

ObjectGraph::Extent ObjectGraph::visit(const Object& object, const Location& where,
                                       std::size_t depth) {
  const auto [entry, is_new] = extents_.try_emplace(&object);
  if (!is_new && entry->second.height == 0) {
    throw InputError(where, fmt::format("{} contains itself by this reference", called(object)));
  }
  const std::size_t height = is_new ? 1 : entry->second.height;
  if (depth + height - 1 > kDeepestGraph) {
    throw InputError(where, "objects and references are nested more than 64 deep");
  }
  if (!is_new) return entry->second;
  return extents_[&object] = extent_below(object, depth);
}

ObjectGraph::Extent ObjectGraph::extent_below(const Object& object, std::size_t depth) {
  Extent all{1, 1};
  const auto include = [&](const Extent& child, bool counts_once) {
    all.height = std::max(all.height, child.height + 1);
    all.objects += counts_once ? 1 : child.objects;
    if (all.objects > kMostObjects) {
      throw InputError(object.where,
                       fmt::format("{} stands for more than {} objects when its references are "
                                   "followed",
                                   called(object), kMostObjects));
    }
  };
  for (const Property& property : object.properties) {
    const auto* const child = std::get_if<std::shared_ptr<const Object>>(&property.value);
    if (child != nullptr && *child != nullptr) {
      include(visit(**child, property.where, depth + 1), false);
    }
  }
  const auto found = references_.find(&object);
  if (found == references_.end()) return all;
  for (const Edge& edge : found->second) {
    include(visit(*edge.to, edge.where, depth + 1), edge.to->tag == "shape");
  }
  return all;
}

}  // namespace pharos::mitsuba
