#pragma once

#include <memory>
#include <string>

namespace pharos {

/// Base of every object that a plugin makes. A component is immutable once built: it holds its
/// settings and what follows from them. State that belongs to one render lives in the separate
/// objects that components make for it (Prepared…: constant during a render; …State: changes
/// between iterations). Each contract names itself with a static `contract_name`.
class Component {
 public:
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  /// The name it was registered and built under; empty when it was not made by a Registry.
  const std::string& plugin_name() const { return plugin_name_; }

 protected:
  Component() = default;

 private:
  friend class Registry;
  std::string plugin_name_;
};

/// How components are held: shared and immutable. Null only where a docstring says so.
template <class Contract>
using Ref = std::shared_ptr<const Contract>;

}  // namespace pharos
