# The software bill of materials of a build, by `cmake --build build/release --target sbom`: CycloneDX 1.5 (ECMA-424).
# Lists what the program is compiled with (packages_play in game/setup) and every shared library that the programs load, by Debian
# package and version. Wants Debian's dpkg.
cmake_policy(VERSION 3.25)
file(READ ${SETUP} TEXT)
string(REGEX MATCH "packages_play=\\(([^)]*)\\)" FOUND "${TEXT}")
string(REGEX MATCHALL "[^ \n]+" BUILT_WITH "${CMAKE_MATCH_1}")

file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${PROGRAMS} LIBRARIES ${CODECS} RESOLVED_DEPENDENCIES_VAR LIBRARIES_LOADED
    UNRESOLVED_DEPENDENCIES_VAR MISSING)
foreach(FILE ${LIBRARIES_LOADED})
    file(REAL_PATH ${FILE} REAL)
    # Debian merged /lib into /usr/lib, and packages still name either.
    string(REGEX REPLACE "^/usr/lib/" "/lib/" OTHER ${REAL})
    list(APPEND FILES ${REAL} ${OTHER})
endforeach()
execute_process(COMMAND dpkg-query -S ${FILES} OUTPUT_VARIABLE OWNERS ERROR_QUIET)
string(REGEX MATCHALL "[^\n:]+:[^\n ]*: /[^\n]*" LINES "${OWNERS}")
foreach(LINE ${LINES})
    string(REGEX REPLACE ":.*" "" PACKAGE "${LINE}")
    list(APPEND LOADED ${PACKAGE})
endforeach()

set(PACKAGES ${BUILT_WITH} ${LOADED})
list(SORT PACKAGES)
list(REMOVE_DUPLICATES PACKAGES)
execute_process(COMMAND dpkg-query -W -f "\${binary:Package} \${Version}\\n" ${PACKAGES} OUTPUT_VARIABLE VERSIONS
    RESULT_VARIABLE STATUS)
if(NOT STATUS EQUAL 0 OR MISSING)
    message(FATAL_ERROR "sbom: dpkg does not know all of the packages, or a library is missing: ${MISSING}")
endif()
set(BILL "{\"bomFormat\":\"CycloneDX\",\"specVersion\":\"1.5\",\"version\":1,\"components\":[]}")
string(JSON BILL SET "${BILL}" metadata "{\"component\":{\"type\":\"application\",\"name\":\"shoal\",\"version\":\"${VERSION}\"}}")
string(REGEX MATCHALL "[^\n]+" LINES "${VERSIONS}")
set(COUNT 0)
foreach(LINE ${LINES})
    string(REGEX MATCH "^([^ :]+)[^ ]* (.*)$" FOUND "${LINE}")
    string(JSON BILL SET "${BILL}" components ${COUNT} "{\"type\":\"library\",\"name\":\"${CMAKE_MATCH_1}\",\
\"version\":\"${CMAKE_MATCH_2}\",\"purl\":\"pkg:deb/debian/${CMAKE_MATCH_1}@${CMAKE_MATCH_2}\"}")
    math(EXPR COUNT "${COUNT} + 1")
endforeach()
file(WRITE ${OUT} "${BILL}\n")
message("sbom: ${COUNT} components in ${OUT}")
