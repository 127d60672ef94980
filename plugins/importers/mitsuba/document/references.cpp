#include "references.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "object_graph.h"

namespace pharos::mitsuba {
namespace {

/// The limit for chains of aliases; aliases may name other aliases.
constexpr int kMostAliases = 64;
/// The longest id that may have been typed by hand. Finding the nearest id takes time proportional
/// to the square of its length.
constexpr std::size_t kLongestTyped = 60;

}  // namespace

void References::define(const std::string& id, Named named) {
  const Location where = named.where;
  const auto [entry, is_new] = named_.try_emplace(id, std::move(named));
  if (is_new) return;
  throw InputError(where, fmt::format("the id '{}' is taken: see {}", one_line(id, 60),
                                      entry->second.where.to_string()));
}

void References::define(const std::string& id, std::shared_ptr<Object> object,
                        const Location& where) {
  define(id, Named{std::move(object), "", where});
}

void References::define_alias(const std::string& name, const std::string& id,
                              const Location& where) {
  define(name, Named{nullptr, id, where});
  aliases_.push_back({nullptr, 0, name, where});
}

void References::refer(Object& from, std::size_t property, const std::string& id,
                       const Location& where) {
  references_.push_back({&from, property, id, where});
}

std::shared_ptr<Object> References::find(const Reference& reference) const {
  const std::string* id = &reference.id;
  const Location* where = &reference.where;
  for (int steps = 0; steps <= kMostAliases; ++steps) {
    const auto found = named_.find(*id);
    if (found == named_.end()) fail_unknown(*id, *where);
    if (found->second.object != nullptr) return found->second.object;
    id = &found->second.alias_of;
    where = &found->second.where;
  }
  throw InputError(reference.where,
                   fmt::format("expected at most {} aliases from '{}' to an object; do they name "
                               "each other?",
                               kMostAliases, one_line(reference.id, 60)));
}

void References::fail_unknown(const std::string& id, const Location& where) const {
  const std::string message = fmt::format("nothing has the id '{}'", one_line(id, kLongestTyped));
  if (id.size() > kLongestTyped) throw InputError(where, message);
  std::vector<std::string> known;
  for (const auto& [name, named] : named_) known.push_back(name);
  std::sort(known.begin(), known.end());
  throw InputError(where, message + suggestion(id, known));
}

void References::resolve(const Object& scene) {
  for (const Reference& alias : aliases_) find(alias);
  ObjectGraph graph;
  for (Reference& reference : references_) {
    reference.to = find(reference);
    graph.add(*reference.from, *reference.to, reference.where);
  }
  graph.check(scene);
  for (Reference& reference : references_) {
    reference.from->properties[reference.property].value =
        std::shared_ptr<const Object>(std::move(reference.to));
  }
}

}  // namespace pharos::mitsuba
