#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "document.h"

namespace pharos::mitsuba {

/// The ids of a scene and the references to them. A reference may come before the object that has
/// the id.
class References {
 public:
  /// Registers the id of an object. Throws InputError if the id is already taken.
  void define(const std::string& id, std::shared_ptr<Object> object, const Location& where);
  /// Makes `name` a second name for the id `id`. Throws InputError in the same way as define().
  void define_alias(const std::string& name, const std::string& id, const Location& where);
  /// Records that the property at this index of `from`, an empty object, refers to the id.
  void refer(Object& from, std::size_t property, const std::string& id, const Location& where);

  /// Fills in every reference of `scene`. Throws InputError for unknown ids, cycles, and objects
  /// that are nested too deeply or expand to too many objects.
  void resolve(const Object& scene);

 private:
  struct Named {
    std::shared_ptr<Object> object;  ///< null for an alias
    std::string alias_of;
    Location where;
  };
  struct Reference {
    Object* from;
    std::size_t property;
    std::string id;
    Location where;
    std::shared_ptr<Object> to = nullptr;
  };

  void define(const std::string& id, Named named);
  std::shared_ptr<Object> find(const Reference& reference) const;
  [[noreturn]] void fail_unknown(const std::string& id, const Location& where) const;

  std::unordered_map<std::string, Named> named_;
  std::vector<Reference> references_;
  std::vector<Reference> aliases_;  ///< have no `from`; they must name something even if they are
                                    ///< not used
};

}  // namespace pharos::mitsuba
