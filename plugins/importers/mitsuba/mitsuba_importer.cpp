// xml: scenes of Mitsuba, versions 0.x, 2 and 3. document.h reads the file and mapping.h maps each
// object; docs/mitsuba.md lists what is supported, approximated and refused.
#include "mitsuba_importer.h"

#include "mapping/mapping.h"

namespace pharos {

Import MitsubaImporter::import(const std::filesystem::path& file) const {
  return mitsuba::map_document(mitsuba::read_document(file));
}

}  // namespace pharos
