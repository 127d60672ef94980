#include <fmt/format.h>

#include <pharos/transport/path_text.h>
#include <pharos/transport/splats.h>

namespace pharos {
namespace {

const char* kind_name(VertexKind kind) {
  switch (kind) {
    case VertexKind::sensor:
      return "sensor";
    case VertexKind::surface:
      return "surface";
    case VertexKind::volume:
      return "volume";
    case VertexKind::environment:
      return "environment";
    case VertexKind::light:
      return "light";
  }
  return "?";
}

const char* event_name(Event event) {
  switch (event) {
    case Event::none:
      return "end";
    case Event::smooth_reflect:
      return "smooth reflect";
    case Event::smooth_transmit:
      return "smooth transmit";
    case Event::discrete_reflect:
      return "discrete reflect";
    case Event::discrete_transmit:
      return "discrete transmit";
    case Event::pass_through:
      return "pass through";
    case Event::scatter:
      return "scatter";
  }
  return "?";
}

std::string text(Vec3 v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}
std::string text(Rgb c) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", c.r, c.g, c.b);
}

/// Returns shares and densities of all techniques, such as " (share 0.5 of unguided 0.31, 0.5 of
/// method 1 2.2)". Returns an empty text if there is only one technique.
std::string text(std::span<const Technique> techniques) {
  if (techniques.size() < 2) return {};
  std::string out =
      fmt::format(" (share {:.3g} of unguided {:.6g}", techniques[0].share, techniques[0].density);
  for (std::size_t i = 1; i < techniques.size(); ++i) {
    out +=
        fmt::format(", {:.3g} of method {} {:.6g}", techniques[i].share, i, techniques[i].density);
  }
  return out + ')';
}

/// Returns the branch that has come to vertex `i`, such as "  branch 2 after 1". Returns an empty
/// text if the path came there undivided from the vertex before.
std::string branch_text(const RecordedVertex& vertex, std::uint32_t i) {
  if (vertex.branch == 0 && (i == 0 || vertex.parent + 1 == i)) return {};
  return fmt::format("  branch {} after {}", vertex.branch, vertex.parent);
}

}  // namespace

std::string path_text(const PathView& path, Rgb radiance) {
  std::string out = fmt::format("film ({:.4f}, {:.4f}) px   radiance {}\n", path.film.x,
                                path.film.y, text(radiance));
  std::size_t light = 0;
  for (std::uint32_t i = 0; i < path.vertices.size(); ++i) {
    const RecordedVertex& v = path.vertices[i];
    out += fmt::format("{:3} {:<11} at {}  throughput {}{}\n", i, kind_name(v.kind),
                       text(v.position), text(v.throughput), branch_text(v, i));
    if (!is_black(v.emission)) out += fmt::format("      emission {}\n", text(v.emission));
    for (; light < path.light_samples.size() && path.light_samples[light].vertex == i; ++light) {
      const RecordedLightSample& s = path.light_samples[light];
      out += fmt::format("      light sample at {}  contribution {}  MIS weight {:.4g}\n",
                         text(s.position), text(s.contribution), s.mis_weight);
    }
    out += fmt::format("      {}", v.continuation == 0 ? "roulette" : event_name(v.event));
    if (v.event != Event::none) {
      out += fmt::format(" to {}  weight {}  pdf {:.6g}{}", text(v.direction), text(v.local_weight),
                         v.pdf, text(path.techniques(v)));
    }
    out += '\n';
  }
  return out;
}

void LightPathTeller::arrive(const Path& path) {
  text_ +=
      fmt::format("{:3} {:<11} at {}  throughput {}\n", number_++, kind_name(path.current.kind),
                  text(path.current.position), text(path.throughput));
}

void LightPathTeller::contribute(Vec2 film, Rgb contribution) {
  total_ += contribution;
  text_ += fmt::format("      seen at film ({:.4f}, {:.4f}) px: {}\n", film.x, film.y,
                       text(contribution));
}

}  // namespace pharos
