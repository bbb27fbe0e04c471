# Writes OUTPUT, a header with the commit and the dirty flag of SOURCE, and
# touches it only when they changed.  Run at every build:
#     cmake -D SOURCE=dir -D OUTPUT=file -P build_facts.cmake
cmake_policy(VERSION 3.25)
set(COMMIT unknown)
set(DIRTY unknown)
find_program(GIT git)
if(GIT)
  # A source tree unpacked inside somebody else's checkout is not that checkout.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel HEAD
                  OUTPUT_VARIABLE answer RESULT_VARIABLE failed ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(REAL_PATH ${SOURCE} source)
  if(failed STREQUAL "0" AND answer MATCHES "^(.*)\n([0-9a-f]+)$" AND CMAKE_MATCH_1 STREQUAL source)
    set(COMMIT ${CMAKE_MATCH_2})
    # Stored references are no part of a build: accepting some leaves it as clean as it was.
    execute_process(COMMAND ${GIT} -C ${SOURCE} --no-optional-locks status --porcelain
                            -- . ":(exclude)reference"
                    OUTPUT_VARIABLE changes RESULT_VARIABLE failed ERROR_QUIET)
    if(failed STREQUAL "0")
      set(DIRTY clean)
      if(changes)
        set(DIRTY dirty)
      endif()
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
"#define BUILD_COMMIT \"${COMMIT}\"
#define BUILD_DIRTY \"${DIRTY}\"
")
