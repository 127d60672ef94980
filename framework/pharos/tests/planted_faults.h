#pragma once

#include <string>

#include <pharos/conformance/conformance.h>

/// Planted faults: plugins whose settings name the fault with which they are built.
namespace pharos::test {

/// The settings of a plugin that is sound except for the fault `planted`.
template <class Fault>
struct FaultSettings {
  static inline Fault planted = Fault::none;
  static void describe(Schema<FaultSettings>&) {}
};

/// Returns the names of the checks that failed, in one text.
inline std::string red(const conformance::Report& report) {
  std::string text;
  for (const std::string& name : failed_checks(report)) text += (text.empty() ? "" : " ") + name;
  return text;
}

/// Returns the conformance report on the plugin P with a fault.
template <class P, class Fault>
conformance::Report report_with(Fault fault) {
  FaultSettings<Fault>::planted = fault;
  Registry registry;
  registry.add<P>("subject", "Planted fault");
  return conformance::check_plugins(registry);
}

template <class P, class Fault>
std::string red_with(Fault fault) {
  return red(report_with<P>(fault));
}

}  // namespace pharos::test
