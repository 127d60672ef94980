# The report page: the library carries the page's HTML, styles, scripts and the chart library.
# Included by the folder that makes the target, which alone may use what a custom command writes.
set(page_folder ${CMAKE_CURRENT_LIST_DIR})
set(page_scripts data.js format.js theme.js color.js table.js charts.js image_view.js
  image_input.js comparison.js pictures.js texts.js main.js)
set(page_sources page.html page.css ${page_scripts})
list(TRANSFORM page_sources PREPEND ${page_folder}/)
string(REPLACE ";" "," script_list "${page_scripts}")
set(page_shell ${CMAKE_CURRENT_BINARY_DIR}/page_shell.cpp)
add_custom_command(OUTPUT ${page_shell}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${page_shell} -DFOLDER=${page_folder}
          -DCHART=${PHAROS_CHART_JS} -DSCRIPTS=${script_list} -P ${page_folder}/embed.cmake
  DEPENDS ${page_folder}/embed.cmake ${page_sources} ${PHAROS_CHART_JS}
  COMMENT "Writing the report page" VERBATIM)
target_sources(pharos_experiments PRIVATE ${page_shell}
  report/half.cpp report/packed_image.cpp report/page_data.cpp report/report.cpp)
target_link_libraries(pharos_experiments PRIVATE ZLIB::ZLIB)
