#include <pharos/laboratory/integrands/edge.h>
#include <pharos/laboratory/integrands/textured.h>

namespace pharos::laboratory {

void Textured::Settings::describe(Schema<Settings>& s) {
  describe_edges(s);
  s.field("frequency", &Settings::frequency, "Frequency of the texture's wave along x and y")
      .unit("periods per side of the square")
      .at_least(-1000)
      .at_most(1000)
      .check("not zero", [](Vec2 f) { return f.x != 0 || f.y != 0; });
  s.field("contrast", &Settings::contrast, "Amplitude of the wave around 1").at_least(0).at_most(1);
}

}  // namespace pharos::laboratory
