# Writes the report page without its data as C++ source: cmake -DOUTPUT=… -DFOLDER=… -DCHART=…
# -DSCRIPTS=a.js,b.js -P embed.cmake
file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/page.css style)
file(READ ${CHART} chart)
set(script "")
string(REPLACE "," ";" names "${SCRIPTS}")
foreach(name ${names})
  file(READ ${FOLDER}/${name} text)
  string(APPEND script "${text}\n")
endforeach()

# The browser would end an element there, whatever the script means by it.
foreach(part script chart)
  string(TOLOWER "${${part}}" text)
  if(text MATCHES "</script|<!--")
    message(FATAL_ERROR "the report's ${part} must not contain '</script' or '<!--'")
  endif()
endforeach()
foreach(part style chart script)
  string(REPLACE "@${part}@" "${${part}}" page "${page}")
endforeach()

file(WRITE ${OUTPUT}.html "${page}")
file(READ ${OUTPUT}.html bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)"
  "\\1\n" bytes "${bytes}")
file(WRITE ${OUTPUT} "#include <pharos/experiments/report/page_shell.h>

namespace pharos {
namespace {
constexpr unsigned char kPage[] = {
${bytes}};
}  // namespace

std::string_view page_shell() { return {reinterpret_cast<const char*>(kPage), sizeof kPage}; }

}  // namespace pharos
")
