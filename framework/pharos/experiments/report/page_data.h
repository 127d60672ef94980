#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pharos/experiments/report/packed_image.h>
#include <pharos/experiments/report/report.h>

namespace pharos {

/// An image of the page. The page's data refer to it by its index in PageData::images.
struct PageImage {
  const Image* image;
  PackedImage (*pack)(const Image&);
};

/// The data that the page's scripts read. Numbers that JSON lacks are null (NaN) or "Infinity" and
/// "-Infinity". Bytes that are not UTF-8 become U+FFFD.
struct PageData {
  std::string json;               ///< safe in a <script> element: no '<', '>' or '&'
  std::vector<PageImage> images;  ///< valid as long as the report exists
};

PageData page_data(const Report& report);

/// Converts `text` to UTF-8 for HTML text and quoted attributes, on one line.
std::string html_text(std::string_view text);

}  // namespace pharos
