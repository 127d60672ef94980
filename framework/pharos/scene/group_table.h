#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// An entry `{ type: instance, group: NAME, to_world: … }` as written in the config.
struct InstanceEntry {
  std::string group;
  Transform to_world;
  Location where;  ///< location of the group's name
};

/// The entries of a group or of the world.
struct EntryList {
  std::vector<SceneObject> objects;
  std::vector<InstanceEntry> instances;
};

/// The groups of a scene by name. Groups may contain instances of each other. SceneParts may not
/// nest instances, so the table flattens them into instances that stand in the world.
class GroupTable {
 public:
  /// Limits on the levels of nested groups and on the number of instances in the world.
  static constexpr std::size_t kDeepest = 64;
  static constexpr std::uint64_t kMostInstances = 1u << 22;  ///< about 2 GiB of memory

  void add(std::string name, EntryList entries);
  /// Moves the world's entries to `parts`, together with all groups that are visible there. Call it
  /// once, when all groups are known. Throws InputError with the location
  /// - for unknown group names, and for groups that contain themselves or are nested too deeply,
  ///   whether these groups are used or not;
  /// - for too many instances;
  /// - for instances that are scaled beyond the range of a float.
  void place(EntryList world, SceneParts& parts);

 private:
  static constexpr std::uint32_t kUnplaced = ~0u;

  struct Group {
    std::string name;
    EntryList entries;
    std::vector<std::uint32_t> targets = {};  ///< groups of `entries.instances`, in the same order
    enum class Count { unknown, running, known } state = Count::unknown;
    std::uint64_t count = 0;  ///< instances that one instance of it becomes in the world, capped
    std::size_t depth = 1;    ///< levels of groups, including this one
    std::uint32_t index = kUnplaced;  ///< index in SceneParts::groups
    Bounds3 bounds;                   ///< bounds of its own objects, once it is placed
  };

  std::uint32_t target_of(const InstanceEntry& entry) const;
  std::vector<std::uint32_t> targets_of(const EntryList& entries) const;
  void count(std::uint32_t group);
  void count_within(Group& outer, std::uint32_t inner, const Location& where);
  [[noreturn]] void fail_circle(std::uint32_t group, const Location& where) const;
  void place_instances(const EntryList& entries, const std::vector<std::uint32_t>& targets,
                       const Transform& to_world, SceneParts& parts);

  std::vector<Group> groups_;
  std::map<std::string, std::uint32_t, std::less<>> by_name_;
  std::vector<std::uint32_t> chain_;  ///< groups whose count is in progress, outermost first
};

}  // namespace pharos
