#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <pharos/scene/group_table.h>
#include <pharos/scene/placement.h>
#include <pharos/scene/reach.h>

namespace pharos {
namespace {

/// The range of the factor by which a map may scale volumes. Within it, all terms of the inverse
/// that Embree computes in float are representable.
constexpr float kSmallestVolume = 1e-30f, kLargestVolume = 1e30f;

/// Returns the place of an instance in world space. `outer` is the place of the group that lists
/// it.
Transform composed(const Transform& outer, const InstanceEntry& entry) {
  try {
    const Transform map = outer * entry.to_world;
    const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
    const float volume = abs_dot(cross(x, y), z);
    if (volume >= kSmallestVolume && volume <= kLargestVolume) return map;
  } catch (const InputError&) {  // an element is beyond the range of a float
  }
  throw InputError(entry.where, "this instance is scaled beyond what a float can hold");
}

void check_extent(const Bounds3& group, const Transform& to_world, const Location& where) {
  try {
    check_reach(placed_bounds(group, to_world), "the instance");
  } catch (const InputError& e) {
    throw InputError(where, e.what());
  }
}

}  // namespace

void GroupTable::add(std::string name, EntryList entries) {
  by_name_.emplace(name, static_cast<std::uint32_t>(groups_.size()));
  groups_.push_back({.name = std::move(name), .entries = std::move(entries)});
}

std::uint32_t GroupTable::target_of(const InstanceEntry& entry) const {
  const auto found = by_name_.find(entry.group);
  if (found != by_name_.end()) return found->second;
  std::vector<std::string> names;
  for (const Group& group : groups_) names.push_back(group.name);
  throw InputError(entry.where,
                   fmt::format("unknown group '{}'{}; known: {}", one_line(entry.group, 60),
                               suggestion(entry.group, names), quoted_list(names)));
}

std::vector<std::uint32_t> GroupTable::targets_of(const EntryList& entries) const {
  std::vector<std::uint32_t> targets;
  targets.reserve(entries.instances.size());
  InputErrorList errors;
  for (const InstanceEntry& entry : entries.instances) {
    errors.attempt([&] { targets.push_back(target_of(entry)); });
  }
  errors.raise();
  return targets;
}

void GroupTable::fail_circle(std::uint32_t group, const Location& where) const {
  std::string circle;
  for (auto i = std::find(chain_.begin(), chain_.end(), group); i != chain_.end(); ++i) {
    circle += "'" + groups_[*i].name + "' contains ";
  }
  throw InputError(where, "groups go in a circle: " + circle + "'" + groups_[group].name + "'");
}

void GroupTable::count(std::uint32_t index) {
  Group& group = groups_[index];
  if (group.state == Group::Count::known) return;
  group.state = Group::Count::running;
  chain_.push_back(index);
  group.count = group.entries.objects.empty() ? 0 : 1;
  for (std::size_t i = 0; i < group.targets.size(); ++i) {
    count_within(group, group.targets[i], group.entries.instances[i].where);
  }
  chain_.pop_back();
  group.state = Group::Count::known;
}

void GroupTable::count_within(Group& outer, std::uint32_t index, const Location& where) {
  Group& inner = groups_[index];
  if (inner.state == Group::Count::running) fail_circle(index, where);
  // The limit holds in both cases: `chain_` limits the depth of groups that are not counted yet,
  // and `depth` limits the depth of groups that are.
  if (chain_.size() < kDeepest) count(index);
  outer.depth = std::max(outer.depth, inner.depth + 1);
  if (inner.state != Group::Count::known || outer.depth > kDeepest) {
    throw InputError(where, fmt::format("groups are nested more than {} levels deep", kDeepest));
  }
  outer.count = std::min(outer.count + inner.count, kMostInstances + 1);
}

void GroupTable::place(EntryList world, SceneParts& parts) {
  const std::vector<std::uint32_t> targets = targets_of(world);
  for (Group& group : groups_) group.targets = targets_of(group.entries);
  for (std::uint32_t i = 0; i < groups_.size(); ++i) count(i);
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    total += groups_[targets[i]].count;
    if (total <= kMostInstances) continue;
    throw InputError(world.instances[i].where,
                     fmt::format("this makes more than {} instances, nested ones multiplied out",
                                 kMostInstances));
  }
  parts.objects = std::move(world.objects);
  parts.instances.reserve(total);
  place_instances(world, targets, Transform(), parts);
}

void GroupTable::place_instances(const EntryList& entries,
                                 const std::vector<std::uint32_t>& targets,
                                 const Transform& to_world, SceneParts& parts) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Group& group = groups_[targets[i]];
    if (group.count == 0) continue;  // it may nest very many empty instances
    const Transform map = composed(to_world, entries.instances[i]);
    if (!group.entries.objects.empty()) {
      if (group.index == kUnplaced) {
        group.index = static_cast<std::uint32_t>(parts.groups.size());
        parts.groups.push_back({group.entries.objects});
        for (const SceneObject& o : group.entries.objects) group.bounds.add(o.shape->bounds());
      }
      check_extent(group.bounds, map, entries.instances[i].where);
      parts.instances.push_back({group.index, map});
    }
    place_instances(group.entries, group.targets, map, parts);
  }
}

}  // namespace pharos
