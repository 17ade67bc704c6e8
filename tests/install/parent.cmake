# Configures a project that adds this one as a folder, and compiles its files.
# cmake -D SOURCE= -D WORK= -D COMPILER= -D GENERATOR= -P parent.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/helpers.cmake)
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/install/parent -B ${WORK} -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D METAMORPH=${SOURCE} ${no_packages_of_evolve})
run(${CMAKE_COMMAND} --build ${WORK} --target consumer)
if(NOT "${output}${errors}" MATCHES "unused")
  message(FATAL_ERROR "no warning was seen:\n${output}${errors}")
endif()
