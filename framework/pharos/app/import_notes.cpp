#include "import_notes.h"

#include <pharos/core/error.h>
#include <pharos/core/log.h>

namespace pharos {

void tell_notes(const std::vector<ImportNote>& notes, bool strict) {
  if (strict && !notes.empty()) throw InputError(notes.front().where, notes.front().message);
  for (const ImportNote& note : notes) log_warning(note.to_string());
}

}  // namespace pharos
