# Makes page_parts.cpp of the page's own sources: cmake -D FOLDER=... -D OUT=... -P embed.cmake
# Every page carries them: without indentation, and without lines that are comments.
set(code "#include \"evolve/replay/page_parts.h\"\n\nnamespace metamorph::evolve {\n\n")
foreach(kind html css js)
  file(READ ${FOLDER}/page.${kind} text)
  string(REGEX REPLACE "\n[ \n]+" "\n" text "\n${text}")
  string(REGEX REPLACE "\n//[^\n]*" "" text "${text}")
  string(SUBSTRING "${text}" 1 -1 text)
  string(APPEND code "const std::string_view page_${kind} = R\"~page~(${text})~page~\";\n")
endforeach()
string(APPEND code "\n}  // namespace metamorph::evolve\n")
file(WRITE ${OUT} "${code}")
