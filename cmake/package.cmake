# `cmake --build --preset release --target package`: Debian packages, soilbin (the command and its cases), libsoilbin-dev
# (the libraries) and, where it is built, python3-soilbin (the Python package and the notebooks).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME soilbin)
set(CPACK_PACKAGE_CONTACT "The soilbin developers <soilbin@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Traction and sinkage of a wheel on soil")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME soilbin)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libjs-three, node-d3")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsoilbin-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS libassimp-dev libeigen3-dev libfmt-dev libgsl-dev libhdf5-dev
       libhwy-dev libyaml-cpp-dev nlohmann-json3-dev zlib1g-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS soilbin)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
  "The command soilbin with its tires, soils, studies and measured campaigns: drawbar pull, torque, sinkage and
lateral force of a wheel on soil by the Bekker / Wong-Reece model with published effects, by discrete elements in a
virtual soil bin, and the comparison with measurements.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Static libraries, headers and a CMake package: find_package(soilbin) gives soilbin::scenario,
soilbin::bekker_wong, soilbin::dem and soilbin::compare.")
if(TARGET soilbin_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-soilbin)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next "${python_minor} + 1")
  string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "soilbin (= ${PROJECT_VERSION})"
    "python3 (>= 3.${python_minor})" "python3 (<< 3.${next})" python3-numpy python3-pandas)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, jupyter-nbconvert, python3-ipykernel")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "jupyter-notebook, python3-ipywidgets")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "soilbin in Python: the analytic wheel, grains, measured campaigns and the loop as classes, numpy arrays and pandas
frames, with nine notebooks that teach terramechanics.")
endif()
include(CPack)
