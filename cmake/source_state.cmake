cmake_minimum_required(VERSION 3.25)
# Run at every build (-P) with SOURCE, TARGET and VERSION: writes the state of the sources into a header, which changes
# only where the state does. A source tree without git has its version alone.
execute_process(COMMAND git -c safe.directory=${SOURCE} -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE state OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${SOURCE}/.git)
  set(state "release ${VERSION}")
endif()
file(CONFIGURE OUTPUT ${TARGET} CONTENT "#define SOILBIN_SOURCE_STATE \"@state@\"\n" @ONLY)
