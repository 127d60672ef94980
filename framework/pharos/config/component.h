#pragma once

#include <memory>
#include <string>

namespace pharos {

/// The base class of every object that a plugin makes. A component is immutable once built: it
/// holds its settings and values that follow from them. State that belongs to one render lives in
/// separate objects that components make for it (Prepared…: constant during a render; …State:
/// changes between iterations). Each contract has a static member `contract_name` with its name.
class Component {
 public:
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  /// The name under which the component was registered and built. Empty if no Registry made it.
  const std::string& plugin_name() const { return plugin_name_; }

 protected:
  Component() = default;

 private:
  friend class Registry;
  std::string plugin_name_;
};

/// A shared pointer to an immutable component. It is null only if a docstring says so.
template <class Contract>
using Ref = std::shared_ptr<const Contract>;

}  // namespace pharos
