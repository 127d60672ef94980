#include "document.h"

#include <algorithm>

#include "document_reader.h"

namespace pharos::mitsuba {

const Property* Object::find(std::string_view name) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const Property& p) { return p.name == name; });
  return found == properties.end() ? nullptr : &*found;
}

Document read_document(const std::filesystem::path& file,
                       const std::map<std::string, std::string>& parameters) {
  return DocumentReader(file, parameters).read();
}

}  // namespace pharos::mitsuba
