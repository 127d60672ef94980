#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// `{ type: instance, group: NAME, to_world: … }` as it was written.
struct InstanceEntry {
  std::string group;
  Transform to_world;
  Location where;  ///< of the group's name
};

/// What the list of a group, or that of the world, holds.
struct EntryList {
  std::vector<SceneObject> objects;
  std::vector<InstanceEntry> instances;
};

/// The groups of a scene by name. They may contain instances of each other; a scene may not: what
/// comes out are instances that stand in the world.
class GroupTable {
 public:
  /// Levels of groups within groups, and instances in the world.
  static constexpr std::size_t kDeepest = 64;
  static constexpr std::uint64_t kMostInstances = 1u << 22;  ///< some 2 GiB

  void add(std::string name, EntryList entries);
  /// Takes the world's entries to `parts`, with all groups that are seen there. Throws InputError
  /// with the location, used or not, for unknown names and groups that contain themselves or are
  /// nested too deeply; for too many instances, and such as are scaled beyond what a float can
  /// hold. To be called once, when all groups are known.
  void place(EntryList world, SceneParts& parts);

 private:
  static constexpr std::uint32_t kUnplaced = ~0u;

  struct Group {
    std::string name;
    EntryList entries;
    std::vector<std::uint32_t> targets = {};  ///< groups of `entries.instances`
    enum class Count { unknown, running, known } state = Count::unknown;
    std::uint64_t count = 0;          ///< instances that one of it comes to, capped
    std::size_t depth = 1;            ///< levels of groups, itself included
    std::uint32_t index = kUnplaced;  ///< in SceneParts::groups
    Bounds3 bounds;                   ///< of its own objects, once it is placed
  };

  std::vector<std::uint32_t> targets_of(const EntryList& entries) const;
  void count(std::uint32_t group);
  void count_within(Group& outer, std::uint32_t inner, const Location& where);
  [[noreturn]] void fail_circle(std::uint32_t group, const Location& where) const;
  void place_instances(const EntryList& entries, const std::vector<std::uint32_t>& targets,
                       const Transform& to_world, SceneParts& parts);

  std::vector<Group> groups_;
  std::map<std::string, std::uint32_t, std::less<>> by_name_;
  std::vector<std::uint32_t> chain_;  ///< groups that are being counted, outermost first
};

}  // namespace pharos
