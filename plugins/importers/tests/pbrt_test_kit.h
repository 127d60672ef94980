#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "../pbrt/pbrt_importer.h"

/// Scenes of pbrt as texts, and the results of their import.
namespace pharos::pbrt::test {

using pharos::test::TemporaryFolder;

/// Imports a scene file with this text, in a folder of its own.
inline Import import_of(const std::string& text) {
  const TemporaryFolder folder;
  return PbrtImporter().import(folder.write("scene.pbrt", text));
}

/// Imports a scene whose world consists of `world`.
inline Import import_of_world(const std::string& world) {
  return import_of("Camera \"perspective\"\nWorldBegin\n" + world);
}

/// Returns the error message of a scene, without its folder.
inline std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  return pharos::test::input_error_in(
      folder, [&] { PbrtImporter().import(folder.write("scene.pbrt", text)); });
}

/// Returns the messages of all errors of a scene, without its folder.
inline std::vector<std::string> flaws(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("scene.pbrt", text);
  std::vector<std::string> messages;
  try {
    PbrtImporter().import(file);
  } catch (const InputErrors& errors) {
    for (const InputError& error : errors.all()) {
      messages.push_back(pharos::test::input_error_in(folder, [&] { throw InputError(error); }));
    }
  } catch (const InputError& error) {
    messages.emplace_back(error.what());
  }
  return messages;
}

/// Returns the YAML, on one line, of the part of the config at `path`, such as "scene.shapes.0";
/// "none" if there is no such part.
inline std::string part(const Import& import, const std::string& path) {
  const ConfigNode* node = &import.config;
  std::istringstream keys(path);
  for (std::string key; node != nullptr && std::getline(keys, key, '.');) {
    if (!node->is_sequence()) {
      node = node->find(key);
    } else {
      const std::size_t i = std::stoul(key);
      node = i < node->items().size() ? &node->items()[i] : nullptr;
    }
  }
  return node != nullptr ? to_flow_yaml(*node) : "none";
}

/// Returns the messages of the notes, in order.
inline std::vector<std::string> notes(const Import& import) {
  std::vector<std::string> messages;
  for (const ImportNote& note : import.notes) messages.push_back(note.message);
  return messages;
}

}  // namespace pharos::pbrt::test
