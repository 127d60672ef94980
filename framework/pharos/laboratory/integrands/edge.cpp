#include <pharos/laboratory/integrands/edge.h>

namespace pharos::laboratory {

void Edge::Settings::describe(Schema<Settings>& s) {
  describe_edges(s);
}

}  // namespace pharos::laboratory
