# Installs the components that an example needs, into a folder of its own, and builds and runs the
# example against them as a foreign project would: with plain flags, and for another instruction set
# than the library's. And every public header must compile by itself, without a warning.
#
# cmake -D EXAMPLE=core/bodies (room/program of room/example/) -D COMPONENTS=core[;evolve]
#   -D SOURCE= -D BUILD= -D WORK= -D COMPILER= -D GENERATOR= -P run.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/helpers.cmake)
file(REMOVE_RECURSE ${WORK})
cmake_path(GET EXAMPLE PARENT_PATH room)
cmake_path(GET EXAMPLE FILENAME program)
foreach(component IN LISTS COMPONENTS)
  run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${WORK}/prefix)
endforeach()

# Builds SOURCE_FOLDER in WORK/NAME with FLAGS.
function(build source_folder name flags)
  run(${CMAKE_COMMAND} -S ${source_folder} -B ${WORK}/${name} -G ${GENERATOR}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS=${flags} ${without_evolve})
  run(${CMAKE_COMMAND} --build ${WORK}/${name})
endfunction()

if(NOT "evolve" IN_LIST COMPONENTS)
  set(without_evolve ${no_packages_of_evolve})
endif()

build(${SOURCE}/${room}/example plain "")
run(${WORK}/plain/${program})
set(plain_output "${output}")
message("${plain_output}")
if(NOT plain_output MATCHES "[0-9]")
  message(FATAL_ERROR "${EXAMPLE} printed no number")
endif()
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo flags REGEX "^flags.* avx2 .* fma |^flags.* fma .* avx2 " LIMIT_COUNT 1)
  if(flags)
    build(${SOURCE}/${room}/example v3 "-march=x86-64-v3")
    run(${WORK}/v3/${program})
    if(NOT output STREQUAL plain_output)
      message(FATAL_ERROR "compiled for x86-64-v3 ${EXAMPLE} printed:\n${output}")
    endif()
  endif()
endif()

file(GLOB headers RELATIVE ${WORK}/prefix/include ${WORK}/prefix/include/metamorph/*.h)
if(NOT headers)
  message(FATAL_ERROR "no public header was installed")
endif()
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  file(WRITE ${WORK}/headers-source/${name}.cpp "#include <${header}>\n")
endforeach()
file(WRITE ${WORK}/headers-source/CMakeLists.txt "
cmake_minimum_required(VERSION 3.22)
project(headers LANGUAGES CXX)
find_package(metamorph REQUIRED COMPONENTS ${COMPONENTS})
file(GLOB sources *.cpp)
add_library(headers OBJECT \${sources})
target_link_libraries(headers PRIVATE metamorph::${room})
# Warnings of system headers are not shown.
set_target_properties(headers PROPERTIES NO_SYSTEM_FROM_IMPORTED ON)
")
build(${WORK}/headers-source headers "-Wall -Wextra -Wshadow -Wconversion -Werror")
