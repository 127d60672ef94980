#include <pharos/laboratory/integrands/smooth.h>

namespace pharos::laboratory {

void Smooth::Settings::describe(Schema<Settings>& s) {
  s.field("center", &Settings::center, "Position of the peak").unit("sides of the square");
  s.field("width", &Settings::width, "Standard deviation")
      .unit("sides of the square")
      .at_least(0.001)
      .at_most(0.25);
}

}  // namespace pharos::laboratory
