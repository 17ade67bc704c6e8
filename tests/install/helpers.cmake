# run(COMMAND...): sets `output`, and ends with it where the command fails.
macro(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}${errors}")
  endif()
endmacro()

# For cmake: what core must do without.
set(no_packages_of_evolve)
foreach(package SQLite3 PkgConfig fmt nlohmann_json CLI11 GTest rapidcheck benchmark)
  list(APPEND no_packages_of_evolve -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
