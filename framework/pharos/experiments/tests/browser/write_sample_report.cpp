// write-sample-report FILE: writes the page that report_page_test.py drives.

#include <cstdio>
#include <exception>

#include "sample_report.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: write-sample-report FILE\n", stderr);
    return 2;
  }
  try {
    pharos::write_report(pharos::test::sample_report(), argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
