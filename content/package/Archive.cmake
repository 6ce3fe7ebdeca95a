# Completes the portable archive of `cpack -G TXZ`, which holds every library but those that must be the system's. cpack runs
# this script after it has put the program and its content together. Wants Debian's dpkg, and patchelf.
cmake_policy(VERSION 3.25)
set(TOP ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
set(OURS ${TOP}/lib/games/shoal)
set(NOTICES ${TOP}/share/doc/shoal)

# The libraries of C, C++ and OpenGL are the system's alone: its graphics driver may want newer ones than the archive would hold.
set(SYSTEM "^(ld-linux.*|lib(c|m|mvec|dl|pthread|rt|resolv|util|gcc_s|stdc\\+\\+|GL|EGL|GLX|GLdispatch|OpenGL))\\.so")
# The system's drivers and servers use these too, so that the archive's serve only where the system has none.
set(SPARE "^lib(X[^N].*|xcb.*|drm.*|va.*|vdpau|OpenCL|asound|udev|z|zstd|lzma|bz2|expat|elf|ffi|xml2|bsd|md|cap|gcrypt|gpg-error|\
pcre2-8)[-.0-9]*\\.so")
# FFmpeg and OpenCV want these, which take most room of all, for what the game refuses or never does: maps, encoders of H.265
# and AV1, speech of radios, SVG, medical pictures, alphabets of XML, neural networks in trackers, and GStreamer; also teletext,
# parts of which are under version 2 of the GPL alone, which does not agree with the Apache licence of others. In their places
# stand libraries whose functions do nothing and return 0. (A stand-in has no versions of symbols.)
set(STAND_IN "^lib(gdal|x265|SvtAv1Enc|rav1e|codec2|rsvg-2|gdcmMSFF|gdcmDSED|icudata|opencv_dnn|gst.*-1\\.0|zvbi)\\.so")

# does(WHAT COMMAND...): runs a command, whose output is then in SAID.
function(does WHAT)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE STATUS OUTPUT_VARIABLE SAID ERROR_VARIABLE WHY)
    if(NOT STATUS EQUAL 0)
        message(FATAL_ERROR "archive: ${WHAT} failed: ${STATUS} ${WHY}")
    endif()
    set(SAID "${SAID}" PARENT_SCOPE)
endfunction()
# wanted(VARIABLE EXPRESSION...): finds what the program loads, and not what the expressions name nor what that would load.
function(wanted VARIABLE)
    file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${PROGRAMS} LIBRARIES ${MODULES} PRE_EXCLUDE_REGEXES ${ARGN}
        RESOLVED_DEPENDENCIES_VAR FOUND UNRESOLVED_DEPENDENCIES_VAR MISSING)
    if(MISSING)
        message(FATAL_ERROR "archive: these libraries are missing: ${MISSING}")
    endif()
    set(${VARIABLE} "${FOUND}" PARENT_SCOPE)
endfunction()

file(GLOB PROGRAMS ${TOP}/games/*)
file(GLOB MODULES ${OURS}/*.so)
wanted(ALL "${SYSTEM}")
wanted(BROUGHT "${SYSTEM}" "${STAND_IN}")
file(MAKE_DIRECTORY ${OURS}/spare ${NOTICES}/libraries)
foreach(FILE ${BROUGHT})
    get_filename_component(NAME ${FILE} NAME)
    file(REAL_PATH ${FILE} REAL)
    string(REGEX REPLACE "^/usr/lib/" "/lib/" OTHER ${REAL}) # Debian merged them, and packages still name either
    list(APPEND REAL_FILES ${REAL} ${OTHER})
    if(NAME MATCHES "${SPARE}")
        file(COPY_FILE ${REAL} ${OURS}/spare/${NAME})
    else()
        file(COPY_FILE ${REAL} ${OURS}/${NAME})
    endif()
endforeach()

# Writes the stand-ins: the symbols that a library has and that those which are brought want.
does("nm" nm -D --undefined-only --without-symbol-versions ${BROUGHT})
string(REGEX MATCHALL " U [^\n]+" LINES "${SAID}")
foreach(LINE ${LINES})
    set("${LINE}" TRUE)
endforeach()
foreach(FILE ${ALL})
    get_filename_component(NAME ${FILE} NAME)
    if(NOT NAME MATCHES "${STAND_IN}")
        continue()
    endif()
    does("nm" nm -D --defined-only --without-symbol-versions --print-size ${FILE})
    string(REGEX MATCHALL "[^\n]+" LINES "${SAID}")
    set(CODE "")
    foreach(LINE ${LINES})
        string(REGEX MATCH "^[0-9a-f]+ ([0-9a-f]+) ([TDBR]) (.*)$" FOUND "${LINE}")
        if(NOT FOUND OR NOT DEFINED " U ${CMAKE_MATCH_3}")
            continue()
        elseif(CMAKE_MATCH_2 STREQUAL "T")
            string(APPEND CODE "long ${CMAKE_MATCH_3}(void) { return 0; }\n")
        else()
            string(APPEND CODE "char ${CMAKE_MATCH_3}[0x${CMAKE_MATCH_1}];\n")
        endif()
    endforeach()
    file(WRITE ${CPACK_TEMPORARY_DIRECTORY}.c "${CODE}")
    does("the compiler" cc -shared -fPIC -O1 -s -w -fno-builtin -Wl,-soname,${NAME} -o ${OURS}/${NAME} ${CPACK_TEMPORARY_DIRECTORY}.c)
    file(REMOVE ${CPACK_TEMPORARY_DIRECTORY}.c)
endforeach()

# A path of this kind (DT_RPATH) also serves for what libraries load, and holds wherever the folder lies.
does("patchelf (Debian's package patchelf)" patchelf --force-rpath --set-rpath
    "$ORIGIN/../lib/games/shoal:/usr/lib/x86_64-linux-gnu:/lib64:/usr/lib64:/usr/lib:$ORIGIN/../lib/games/shoal/spare" ${PROGRAMS})

# The licences of all of it, and the sources of the libraries.
does("dpkg-query" sh -c "dpkg-query -S \"$@\" 2>/dev/null | sed 's/: .*//' | sort -u" sh ${REAL_FILES})
string(REGEX MATCHALL "[^\n]+" PACKAGES "${SAID}")
does("dpkg-query" dpkg-query -W -f "\${Package} \${Version} \${source:Package} \${source:Version}\\n" ${PACKAGES})
file(WRITE ${NOTICES}/libraries/SOURCES "${SAID}")
string(REGEX MATCHALL "[^\n]+" LINES "${SAID}")
foreach(LINE ${LINES})
    string(REGEX REPLACE " .*" "" PACKAGE "${LINE}")
    file(REAL_PATH /usr/share/doc/${PACKAGE}/copyright COPYRIGHT)
    file(COPY_FILE ${COPYRIGHT} ${NOTICES}/libraries/${PACKAGE})
endforeach()
file(COPY /usr/share/common-licenses DESTINATION ${NOTICES})

# The desktop entry finds the program beside itself, in place of where it was installed.
file(REMOVE_RECURSE ${TOP}/share/applications)
set(TRY_EXEC sh)
set(EXEC [==[sh -c "exec \\"\\$(dirname \\"\\$0\\")/games/shoal\\" \\"\\$@\\"" %k]==])
configure_file(${CMAKE_CURRENT_LIST_DIR}/shoal.desktop.in ${TOP}/shoal.desktop @ONLY)
configure_file(${CMAKE_CURRENT_LIST_DIR}/archive.md.in ${TOP}/README.md @ONLY)
