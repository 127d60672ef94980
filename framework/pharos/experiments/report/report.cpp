#include <algorithm>
#include <fstream>
#include <locale>
#include <string_view>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/experiments/report/page_data.h>
#include <pharos/experiments/report/page_shell.h>
#include <pharos/experiments/report/report.h>

namespace pharos {
namespace {

void require(bool holds, const std::string& otherwise) {
  if (!holds) throw InputError("report: " + otherwise);
}

void check_table(const ReportTable& table, const Report& report) {
  for (const ReportTable::Row& row : table.rows) {
    require(row.cells.size() == report.methods.size(),
            "table '" + table.key + "' has " + std::to_string(row.cells.size()) + " cells for '" +
                row.scene + "', expected one for each of " + std::to_string(report.methods.size()) +
                " methods");
  }
}

void check_curve(const ReportCurve& curve, const Report& report) {
  const std::string of = "the curve of '" + curve.method + "' on '" + curve.scene + "' ";
  require(
      std::find(report.methods.begin(), report.methods.end(), curve.method) != report.methods.end(),
      of + "belongs to no method; there are " + quoted_list(report.methods));
  const std::vector<std::string> axes{"samples", "seconds", "points"};
  require(std::find(axes.begin(), axes.end(), curve.axis) != axes.end(),
          of + "has the axis '" + curve.axis + "', expected one of " + quoted_list(axes));
  require(std::any_of(report.tables.begin(), report.tables.end(),
                      [&](const ReportTable& table) { return table.key == curve.metric; }),
          of + "has the metric '" + curve.metric + "', which is no table's key");
}

void check_scene(const ReportScene& scene) {
  const auto check = [&](const Image& image, int width, int height, const std::string& what) {
    require(!image.empty(), what + " of '" + scene.name + "' has no pixels");
    require(image.width() == width && image.height() == height,
            what + " of '" + scene.name + "' has another size than the scene's first image");
  };
  for (const ReportImage& image : scene.images) {
    const Image& first = scene.images.front().image;
    check(image.image, first.width(), first.height(), "image '" + image.label + "'");
    for (const ReportImage::ErrorMap& map : image.error_maps) {
      check(map.map, first.width(), first.height(), "an error map");
    }
  }
  for (const ReportPicture& picture : scene.pictures) {
    check(picture.image, picture.image.width(), picture.image.height(), "a picture");
  }
}

void check(const Report& report) {
  require(report.baseline.empty() || std::find(report.methods.begin(), report.methods.end(),
                                               report.baseline) != report.methods.end(),
          "the baseline '" + report.baseline + "' is none of the methods " +
              quoted_list(report.methods));
  for (const ReportTable& table : report.tables) check_table(table, report);
  for (const ReportCurve& curve : report.curves) check_curve(curve, report);
  for (const ReportScene& scene : report.scenes) check_scene(scene);
}

void write_image(std::ostream& out, std::size_t index, const PageImage& source) {
  const PackedImage image = source.pack(*source.image);
  out << "<script type=\"text/plain\" id=\"image-" << index << "\" data-width=\"" << image.width
      << "\" data-height=\"" << image.height << "\" data-channels=\"" << image.channels
      << "\" data-scale=\"" << image.scale << "\">" << image.base64 << "</script>\n";
}

void write_page(std::ostream& out, const Report& report) {
  constexpr std::string_view kTitle = "@title@", kData = "@data@";
  const std::string_view shell = page_shell();
  const std::size_t title = shell.find(kTitle), after_title = title + kTitle.size();
  const std::size_t data = shell.find(kData), after_data = data + kData.size();
  const PageData page = page_data(report);
  out.imbue(std::locale::classic());
  out.precision(9);  // enough digits for every bit of a float
  out << shell.substr(0, title) << html_text(report.title)
      << shell.substr(after_title, data - after_title)
      << "<script type=\"application/json\" id=\"report-data\">" << page.json << "</script>\n";
  for (std::size_t i = 0; i < page.images.size(); ++i) write_image(out, i, page.images[i]);
  out << shell.substr(after_data);
}

}  // namespace

void write_report(const Report& report, const std::filesystem::path& path) {
  check(report);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    write_page(out, report);
    out.close();
    if (!out) throw RunError("cannot write '" + path.string() + "'");
  });
}

}  // namespace pharos
