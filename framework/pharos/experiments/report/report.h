#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/statistics/intervals.h>

/// The report page: one self-contained HTML file that needs neither network nor server. All numbers
/// are computed before; the page only shows them. Texts are shown literally, never as HTML. Bytes
/// that are not UTF-8 become U+FFFD. Infinite ends of intervals are shown as infinite.
namespace pharos {

using statistics::Interval;

struct ReportCell {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no value
  std::optional<Interval> interval;                         ///< 95 %, like all intervals here
  std::optional<double> ratio;  ///< this value divided by the baseline's in the same row; not shown
                                ///< in the baseline's column
  std::optional<Interval> ratio_interval;
  bool contends = true;  ///< competes for the best of its row
};

enum class Better { lower, higher, neither };

/// One measure for all methods (columns, in the order of Report::methods) on all scenes (rows).
struct ReportTable {
  std::string key;         ///< such as "relative_mse"
  std::string title;       ///< such as "relMSE"
  std::string unit;        ///< empty: none
  std::string definition;  ///< a sentence below the table
  Better better = Better::lower;
  struct Row {
    std::string scene;
    std::vector<ReportCell> cells;
  };
  std::vector<Row> rows;
};

/// Errors over the work done, for one method on one scene. Points that logarithmic axes cannot show
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
  std::optional<double> slope;  ///< slope of log y over log x
  std::optional<Interval> slope_interval;
};

/// An image that can be compared, with maps of its error. All images of a scene have the same size.
struct ReportImage {
  std::string label;  ///< the method's name, or "reference"
  Image image;        ///< linear radiance R, G, B; other channels are left out
  struct ErrorMap {
    std::string metric;  ///< title of a metric, such as "relMSE"
    Image map;           ///< one channel
  };
  std::vector<ErrorMap> error_maps;
};

/// A picture that is only shown, not compared, such as a slice of a learned density.
struct ReportPicture {
  std::string caption;
  Image image;  ///< one channel, shown in false colors of its logarithm
};

struct ReportScene {
  std::string name;
  std::string note;  ///< a sentence, such as the origin of the reference
  std::vector<ReportImage> images;
  std::vector<ReportPicture> pictures;
};

/// A text that belongs to the results, such as the config of a render or the table as CSV.
struct ReportText {
  std::string title;  ///< also the name of the saved file, with ".txt" unless it has an extension
  std::string text;
};

struct Report {
  std::string title;
  std::string description;
  std::string subject = "scene";  ///< what rows and charts represent, such as "integrand"
  std::vector<std::pair<std::string, std::string>> facts;  ///< version, machine, budget, …
  std::vector<std::string> methods;
  std::string baseline;  ///< one of `methods`; empty: none
  std::vector<ReportTable> tables;
  std::vector<ReportCurve> curves;
  std::vector<ReportScene> scenes;
  std::vector<ReportText> texts;
};

/// Writes the page. The file is written completely or not at all. Throws InputError if the report
/// is inconsistent: rows without a cell for each method, unknown methods, metrics or axes, images
/// that are empty, of a different size than the rest of their scene, or without R, G, B. Throws
/// RunError if the file cannot be written.
void write_report(const Report& report, const std::filesystem::path& path);

}  // namespace pharos
