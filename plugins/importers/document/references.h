#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "document.h"

namespace pharos::mitsuba {

/// What a scene's ids name, and where they are referred to. An id may be referred to before the
/// object that has it.
class References {
 public:
  /// An object has this id. Throws InputError when something else has it already.
  void define(const std::string& id, std::shared_ptr<Object> object, const Location& where);
  /// `name` is another id of what has the id `id`. Throws InputError as define() does.
  void define_alias(const std::string& name, const std::string& id, const Location& where);
  /// The property at this index of `from`, an empty object, stands for what has the id.
  void refer(Object& from, std::size_t property, const std::string& id, const Location& where);

  /// Fills in every reference of `scene`. Throws InputError for unknown ids, cycles, and objects
  /// that are nested too deeply or stand for too many.
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
  std::vector<Reference> aliases_;  ///< from nowhere: they must name something though nothing does
};

}  // namespace pharos::mitsuba
