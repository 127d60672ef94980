#!/bin/sh
# report_page_test.sh WRITE_SAMPLE_REPORT: drives the report page in Chromium; 77 means skipped.
# PHAROS_CHROMIUM names another browser of its kind.
skip() {
  echo "SKIP: $1"
  exit 77
}
command -v python3 > /dev/null || skip "the page needs python3 to be tested: apt-get install python3"
for browser in ${PHAROS_CHROMIUM:-chromium chromium-browser google-chrome}; do
  if command -v "$browser" > /dev/null; then
    exec python3 "$(dirname "$0")/report_page_test.py" "$browser" "$1"
  fi
done
skip "the page needs a browser to be tested: apt-get install chromium"
