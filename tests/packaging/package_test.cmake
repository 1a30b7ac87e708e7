# Makes the Debian packages and looks into them: what they hold, and what they depend on.
# cmake -D BUILD=... -D SCRATCH=... -D VERSION=... -P package_test.cmake
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SCRATCH} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " line)
    message(FATAL_ERROR "${line}\nended with ${status}\n${output}\n${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text what)
  foreach(pattern IN LISTS ARGN)
    if(NOT text MATCHES "${pattern}")
      message(FATAL_ERROR "${what}: no '${pattern}' in\n${text}")
    endif()
  endforeach()
endfunction()

run(cpack --config ${BUILD}/CPackConfig.cmake -B ${SCRATCH})
file(GLOB runtime ${SCRATCH}/soilbin_${VERSION}*.deb)
file(GLOB python ${SCRATCH}/python3-soilbin_${VERSION}*.deb)
file(GLOB development ${SCRATCH}/libsoilbin-dev_${VERSION}*.deb)

run(dpkg-deb --info ${runtime})
expect("${output}" "soilbin's control file" "Package: soilbin\n" "Version: ${VERSION}\n" "Depends: [^\n]*libc6 "
  "Depends: [^\n]*libfmt" "Depends: [^\n]*libgsl" "Depends: [^\n]*libstdc\\+\\+6 " "Depends: [^\n]*libyaml-cpp"
  "Recommends: [^\n]*libjs-three[^\n]*node-d3")
run(dpkg-deb --contents ${runtime})
expect("${output}" "soilbin's files" " ./usr/bin/soilbin\n" " ./usr/share/doc/soilbin/copyright\n"
  " ./usr/share/soilbin/cases/soils/dry-sand.yaml\n" " ./usr/share/soilbin/cases/measured/cmu-smooth/NOTICE.md\n")
if(output MATCHES "\\.hpp|\\.a\n")
  message(FATAL_ERROR "what a developer needs lies in the command's package:\n${output}")
endif()

run(dpkg-deb --info ${development})
expect("${output}" "libsoilbin-dev's control file" "Package: libsoilbin-dev\n"
  "Depends: [^\n]*libeigen3-dev[^\n]*libfmt-dev[^\n]*libgsl-dev[^\n]*libyaml-cpp-dev[^\n]*nlohmann-json3-dev")
run(dpkg-deb --contents ${development})
expect("${output}" "libsoilbin-dev's files" "/libsoilbin_scenario.a\n" "/libsoilbin_bekker_wong.a\n"
  "/libsoilbin_compare.a\n" "/cmake/soilbin/soilbin-config.cmake\n" " ./usr/include/soilbin/scenario/tire.hpp\n")

if(WITH_PYTHON)
  run(dpkg-deb --info ${python})
  expect("${output}" "python3-soilbin's control file" "Package: python3-soilbin\n"
    "Depends: [^\n]*soilbin \\(= ${VERSION}\\), python3 \\(>= 3\\.[0-9]+\\), python3 \\(<< 3\\.[0-9]+\\), python3-numpy, python3-pandas" "Depends: [^\n]*libc6 " "Depends: [^\n]*libhdf5")
  run(dpkg-deb --contents ${python})
  expect("${output}" "python3-soilbin's files" " ./usr/lib/python3/dist-packages/soilbin/__init__.py\n"
    " ./usr/lib/python3/dist-packages/soilbin/_soilbin.cpython-[^ ]*.so\n" "/soilbin/py.typed\n" "/soilbin/_soilbin.pyi\n"
    " ./usr/share/doc/python3-soilbin/notebooks/2-the-rolling-wheel.ipynb\n")
  # Laid out as apt would, it is imported and finds the cases of the package beside it.
  run(dpkg-deb --extract ${python} ${SCRATCH}/installed)
  run(dpkg-deb --extract ${runtime} ${SCRATCH}/installed)
  run(${CMAKE_COMMAND} -E env --unset=SOILBIN_CASES PYTHONPATH=${SCRATCH}/installed/usr/lib/python3/dist-packages
    PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c
    "import soilbin\nprint(soilbin.cases_folders()[0], soilbin.estimate(soilbin.Scenario('rover-wheel', 'dry-sand'), load=80, slip=0.2))")
  expect("${output}" "what python3-soilbin answers" "${SCRATCH}/installed/usr/share/soilbin/cases.*TractionResult\\(drawbar_pull=")
endif()
