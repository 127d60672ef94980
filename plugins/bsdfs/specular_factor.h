#pragma once

#include <string>

#include <pharos/config/registry.h>
#include <pharos/config/schema.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// Declares a texture that scales what is reflected or transmitted: 1 unless stated, never more.
template <class Settings>
void describe_factor(Schema<Settings>& s, std::string key, Ref<Texture> Settings::*member,
                     std::string help) {
  s.field(std::move(key), member, std::move(help))
      .otherwise("1")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
}

}  // namespace pharos
