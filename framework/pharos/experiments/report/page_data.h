#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pharos/experiments/report/packed_image.h>
#include <pharos/experiments/report/report.h>

namespace pharos {

/// An image that the page's data names by its place in PageData::images.
struct PageImage {
  const Image* image;
  PackedImage (*pack)(const Image&);
};

/// What the page's scripts read. Numbers that JSON lacks are null (NaN) or "Infinity" and
/// "-Infinity"; bytes that are not UTF-8 became U+FFFD.
struct PageData {
  std::string json;               ///< safe within a <script> element: no '<', '>' or '&'
  std::vector<PageImage> images;  ///< as long as the report lives
};

PageData page_data(const Report& report);

/// `text` as UTF-8 for HTML's text and quoted attributes, on one line.
std::string html_text(std::string_view text);

}  // namespace pharos
