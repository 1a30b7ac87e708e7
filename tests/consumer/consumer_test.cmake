# Installs the build into a fresh prefix, then configures, builds and runs the project beside this file against it, and
# the installed command away from any source tree.
# cmake -D BUILD=... -D CONSUMER=... -D SCRATCH=... -D VERSION=... -D WITH_COMMAND=yes|no -P consumer_test.cmake
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/elsewhere)
set(prefix ${SCRATCH}/prefix)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SCRATCH}/elsewhere RESULT_VARIABLE status
    OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " line)
    message(FATAL_ERROR "${line}\nended with ${status}\n${output}\n${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${SCRATCH}/build -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_BUILD_TYPE=Debug)
file(STRINGS ${SCRATCH}/build/CMakeCache.txt found REGEX "^soilbin_DIR:PATH=")
if(NOT found MATCHES "=${prefix}/")
  message(FATAL_ERROR "found another soilbin: ${found}")
endif()
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/analytic)
run(${SCRATCH}/build/grains)
run(${SCRATCH}/build/experiment)
run(${SCRATCH}/build/measured ${prefix}/share/soilbin/cases/measured/cmu-smooth)

if(WITH_COMMAND)
  run(${prefix}/bin/soilbin --version)
  if(NOT output MATCHES "${VERSION}")
    message(FATAL_ERROR "soilbin --version doesn't say ${VERSION}: ${output}")
  endif()
  run(${prefix}/bin/soilbin list soils)
  if(NOT output MATCHES "dry-sand")
    message(FATAL_ERROR "the installed command doesn't find its soils: ${output}")
  endif()
endif()
