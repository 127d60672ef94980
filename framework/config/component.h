#pragma once

#include <memory>

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

 protected:
  Component() = default;
};

/// How components are held: shared and immutable. Null only where a docstring says so.
template <class Contract>
using Ref = std::shared_ptr<const Contract>;

}  // namespace pharos
