#include <pharos/core/version.h>
#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/tables/json_number.h>

namespace pharos {
namespace {

using Json = nlohmann::ordered_json;

Json file_json(const ImageFile& image) {
  Json json{{"file", image.file.string()}, {"label", image.label}};
  json["metadata"] = Json::object();
  for (const auto& [name, value] : image.metadata) json["metadata"][name] = value;
  return json;
}

Json metrics_json() {
  Json list = Json::array();
  for (const MetricInfo& info : metric_infos()) {
    list.push_back({{"key", info.key},
                    {"title", info.title},
                    {"unit", info.unit},
                    {"definition", info.definition},
                    {"source", info.source},
                    {"lower_is_better", info.lower_is_better}});
  }
  return list;
}

Json image_json(const Comparison& comparison, std::size_t i) {
  const MeasuredImage& image = comparison.images[i];
  Json json = file_json(image.source);
  json["invalid_pixels"] = image.errors.invalid_pixels;
  json["errors"] = Json::object();
  json["ratios"] = Json::object();
  for (const MetricInfo& info : metric_infos()) {
    const std::string key(info.key);
    json["errors"][key] = json_number<Json>(image.errors[info.metric]);
    if (const auto ratio = comparison.ratio(i, info.metric)) json["ratios"][key] = *ratio;
  }
  return json;
}

}  // namespace

std::string comparison_json(const Comparison& comparison) {
  Json json{{"pharos", version()},
            {"width", comparison.reference.image.width()},
            {"height", comparison.reference.image.height()},
            {"reference", file_json(comparison.reference)},
            {"exposure", comparison.display.exposure},
            {"metrics", metrics_json()},
            {"images", Json::array()}};
  for (std::size_t i = 0; i < comparison.images.size(); ++i) {
    json["images"].push_back(image_json(comparison, i));
  }
  // File names are not necessarily UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace pharos
