#include <cmath>

#include <pharos/core/error.h>
#include <pharos/experiments/report/page_data.h>
#include <pharos/experiments/tables/json_number.h>

namespace pharos {
namespace {

// This type keeps the order of insertion.
using Json = nlohmann::ordered_json;

Json interval(const std::optional<Interval>& bounds) {
  return bounds ? Json{json_number<Json>(bounds->low), json_number<Json>(bounds->high)}
                : Json(nullptr);
}

const char* name(Better better) {
  switch (better) {
    case Better::lower:
      return "lower";
    case Better::higher:
      return "higher";
    case Better::neither:
      break;
  }
  return "neither";
}

Json json(const ReportTable& table) {
  Json rows = Json::array();
  for (const ReportTable::Row& row : table.rows) {
    Json cells = Json::array();
    for (const ReportCell& cell : row.cells) {
      cells.push_back({{"value", json_number<Json>(cell.value)},
                       {"interval", interval(cell.interval)},
                       {"ratio", json_number<Json>(cell.ratio)},
                       {"contends", cell.contends},
                       {"ratio_interval", interval(cell.ratio_interval)}});
    }
    rows.push_back({{"scene", row.scene}, {"cells", cells}});
  }
  return {{"key", table.key},
          {"title", table.title},
          {"unit", table.unit},
          {"definition", table.definition},
          {"better", name(table.better)},
          {"rows", rows}};
}

Json json(const ReportCurve& curve) {
  Json points = Json::array();
  for (const ReportCurve::Point& point : curve.points) {
    points.push_back({{"x", json_number<Json>(point.x)},
                      {"y", json_number<Json>(point.y)},
                      {"interval", interval(point.interval)}});
  }
  return {{"scene", curve.scene},
          {"method", curve.method},
          {"metric", curve.metric},
          {"axis", curve.axis},
          {"points", points},
          {"slope", json_number<Json>(curve.slope)},
          {"slope_interval", interval(curve.slope_interval)}};
}

/// Adds an image and returns the index by which the page finds it.
std::size_t add(std::vector<PageImage>& images, const Image& image,
                PackedImage (*pack)(const Image&)) {
  images.push_back({&image, pack});
  return images.size() - 1;
}

Json json(const ReportScene& scene, std::vector<PageImage>& all) {
  Json images = Json::array(), pictures = Json::array();
  for (const ReportImage& image : scene.images) {
    Json maps = Json::array();
    const std::size_t radiance = add(all, image.image, pack_radiance);
    for (const ReportImage::ErrorMap& map : image.error_maps) {
      maps.push_back({{"metric", map.metric}, {"image", add(all, map.map, pack_map)}});
    }
    images.push_back({{"label", image.label}, {"image", radiance}, {"error_maps", maps}});
  }
  for (const ReportPicture& picture : scene.pictures) {
    pictures.push_back(
        {{"caption", picture.caption}, {"image", add(all, picture.image, pack_map)}});
  }
  return {{"name", scene.name}, {"note", scene.note}, {"images", images}, {"pictures", pictures}};
}

std::string utf8(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Returns `text` with each of the letters `< > & "` replaced by `replacement(letter)`.
template <class Replacement>
std::string escaped(const std::string& text, Replacement&& replacement) {
  std::string result;
  result.reserve(text.size());
  for (const char letter : text) {
    if (letter == '<' || letter == '>' || letter == '&' || letter == '"') {
      result += replacement(letter);
    } else {
      result += letter;
    }
  }
  return result;
}

}  // namespace

PageData page_data(const Report& report) {
  PageData data;
  Json page = {{"title", report.title}, {"description", report.description}};
  page["subject"] = report.subject;
  page["methods"] = report.methods;
  page["baseline"] = report.baseline;
  for (const char* list : {"facts", "tables", "curves", "scenes", "texts"}) {
    page[list] = Json::array();
  }
  for (const auto& [fact, value] : report.facts)
    page["facts"].push_back(Json::array({fact, value}));
  for (const ReportTable& table : report.tables) page["tables"].push_back(json(table));
  for (const ReportCurve& curve : report.curves) page["curves"].push_back(json(curve));
  for (const ReportScene& scene : report.scenes) page["scenes"].push_back(json(scene, data.images));
  for (const ReportText& text : report.texts) {
    page["texts"].push_back({{"title", text.title}, {"text", text.text}});
  }
  // Outside of strings, quotes are the only letters of this set that occur in JSON.
  data.json = escaped(utf8(page), [](char letter) -> std::string {
    switch (letter) {
      case '<':
        return "\\u003c";
      case '>':
        return "\\u003e";
      case '&':
        return "\\u0026";
      default:
        return "\"";
    }
  });
  return data;
}

std::string html_text(std::string_view text) {
  const std::string line = Json::parse(utf8(one_line(text))).get<std::string>();
  return escaped(line, [](char letter) -> std::string {
    switch (letter) {
      case '<':
        return "&lt;";
      case '>':
        return "&gt;";
      case '&':
        return "&amp;";
      default:
        return "&quot;";
    }
  });
}

}  // namespace pharos
