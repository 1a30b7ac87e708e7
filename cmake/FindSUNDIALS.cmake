# CVODES of SUNDIALS and what it needs, as archives: SUNDIALS::<component> for cvodes, nvecserial, sunmatrixdense,
# sunlinsoldense. Debian's libsundials-dev depends on MPI, PETSc, Trilinos and a Fortran compiler (98 MB to fetch, 520 MB
# on disk), of which nothing is called. So packaging/set_up.sh unpacks it below build/unpacked and does not install it;
# an installed one serves as well. From SUNDIALS 7 on (Debian 13) the archives have a core of their own, which calls MPI
# where it was built with it: then MPI is linked too.
set(unpacked ${PROJECT_SOURCE_DIR}/build/unpacked/usr)
find_path(SUNDIALS_INCLUDE_DIR cvodes/cvodes.h HINTS ${unpacked}/include)
if(SUNDIALS_INCLUDE_DIR)
  file(STRINGS ${SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h line REGEX "define SUNDIALS_VERSION \"")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" SUNDIALS_VERSION "${line}")
endif()

set(needed SUNDIALS_INCLUDE_DIR)
if(SUNDIALS_VERSION VERSION_GREATER_EQUAL 7)
  list(APPEND SUNDIALS_FIND_COMPONENTS core)
  file(STRINGS ${SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h calls_mpi REGEX "define SUNDIALS_MPI_ENABLED 1")
  if(calls_mpi)
    find_package(MPI REQUIRED COMPONENTS CXX)
    set(SUNDIALS_MPI MPI::MPI_CXX)
  endif()
endif()
set(SUNDIALS_ARCHIVES ${SUNDIALS_FIND_COMPONENTS})
foreach(component IN LISTS SUNDIALS_FIND_COMPONENTS)
  find_library(SUNDIALS_${component}_LIBRARY NAMES libsundials_${component}.a
    HINTS ${unpacked}/lib/${CMAKE_LIBRARY_ARCHITECTURE} ${unpacked}/lib)
  list(APPEND needed SUNDIALS_${component}_LIBRARY)
  if(SUNDIALS_${component}_LIBRARY AND NOT TARGET SUNDIALS::${component})
    add_library(SUNDIALS::${component} STATIC IMPORTED)
    set_target_properties(SUNDIALS::${component} PROPERTIES IMPORTED_LOCATION ${SUNDIALS_${component}_LIBRARY})
    if(NOT SUNDIALS_INCLUDE_DIR STREQUAL "/usr/include")
      set_target_properties(SUNDIALS::${component} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SUNDIALS_INCLUDE_DIR})
    endif()
  endif()
endforeach()
if(TARGET SUNDIALS::core)
  set_property(TARGET SUNDIALS::core PROPERTY INTERFACE_LINK_LIBRARIES ${SUNDIALS_MPI})
  set_property(TARGET SUNDIALS::cvodes SUNDIALS::nvecserial SUNDIALS::sunmatrixdense SUNDIALS::sunlinsoldense
    PROPERTY INTERFACE_LINK_LIBRARIES SUNDIALS::core)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SUNDIALS REQUIRED_VARS ${needed} VERSION_VAR SUNDIALS_VERSION
  REASON_FAILURE_MESSAGE "bash -c '. packaging/set_up.sh && set_up build' installs the packages and unpacks this one below build/unpacked")
