#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/statistics/intervals.h>

/// The report page: one HTML file that needs nothing else, neither network nor server. All numbers
/// are computed before; the page only shows them. Texts are shown as they are, never as HTML;
/// bytes that are not UTF-8 become U+FFFD. Infinite ends of intervals show as such.
namespace pharos {

using statistics::Interval;

struct ReportCell {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: there is none
  std::optional<Interval> interval;                         ///< of 95 % confidence, as all here
  std::optional<double> ratio;  ///< this value over the baseline's in the same row; not shown in
                                ///< the baseline's column
  std::optional<Interval> ratio_interval;
  bool contends = true;  ///< for the best of its row
};

enum class Better { lower, higher, neither };

/// One measure of all methods (columns, in the order of Report::methods) on all scenes (rows).
struct ReportTable {
  std::string key;         ///< such as "relative_mse"
  std::string title;       ///< such as "relMSE"
  std::string unit;        ///< "" for none
  std::string definition;  ///< a sentence below the table
  Better better = Better::lower;
  struct Row {
    std::string scene;
    std::vector<ReportCell> cells;
  };
  std::vector<Row> rows;
};

/// Errors over the work done, of one method on one scene. Points that logarithmic axes cannot show
/// are left out.
struct ReportCurve {
  std::string scene, method;  ///< the method is one of Report::methods
  std::string metric;         ///< key of a table
  std::string axis;           ///< "samples" [samples a pixel], "seconds" [s] or "points" [1]
  struct Point {
    double x = 0, y = 0;
    std::optional<Interval> interval;
  };
  std::vector<Point> points;
  std::optional<double> slope;  ///< of log y over log x
  std::optional<Interval> slope_interval;
};

/// An image that can be compared, with maps of its error; all of one scene are of one size.
struct ReportImage {
  std::string label;  ///< the method's, "reference" for the reference
  Image image;        ///< R, G, B of linear radiance; other channels are left out
  struct ErrorMap {
    std::string metric;  ///< title of a metric, such as "relMSE"
    Image map;           ///< one channel
  };
  std::vector<ErrorMap> error_maps;
};

/// A picture that is only looked at, such as a slice of a learned density.
struct ReportPicture {
  std::string caption;
  Image image;  ///< one channel, shown in false colors of its logarithm
};

struct ReportScene {
  std::string name;
  std::string note;  ///< a sentence, such as where the reference comes from
  std::vector<ReportImage> images;
  std::vector<ReportPicture> pictures;
};

/// A text that belongs to the results, such as the config of a render or the table as CSV.
struct ReportText {
  std::string title;  ///< also the file's name when saved, ".txt" unless it has an extension
  std::string text;
};

struct Report {
  std::string title;
  std::string description;
  std::string subject = "scene";  ///< what rows and charts are of, such as "integrand"
  std::vector<std::pair<std::string, std::string>> facts;  ///< version, machine, budget, …
  std::vector<std::string> methods;
  std::string baseline;  ///< one of `methods`; "" for none
  std::vector<ReportTable> tables;
  std::vector<ReportCurve> curves;
  std::vector<ReportScene> scenes;
  std::vector<ReportText> texts;
};

/// Writes the page. The file appears whole or not at all. Throws InputError when the report does
/// not fit together: rows without a cell for each method, unknown methods, metrics or axes, images
/// that are empty, of other sizes than the rest of their scene, or without R, G, B; RunError when
/// the file cannot be written.
void write_report(const Report& report, const std::filesystem::path& path);

}  // namespace pharos
