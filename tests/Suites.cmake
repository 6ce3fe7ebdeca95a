# Read by ctest before it runs: makes each suite of the GoogleTest program ${program} one test, with ${properties}. A process for each
# case would load libraries and start the graphics driver five times as often.
execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE suites RESULT_VARIABLE failed)
if(failed)
    add_test("${program} is built and lists its suites" "${program}" --gtest_list_tests)
    return()
endif()
string(REGEX REPLACE "\n +[^\n]*" "" suites "${suites}") # the cases
string(REPLACE "\n" ";" suites "${suites}")
foreach(suite ${suites})
    if(suite MATCHES "^([A-Za-z0-9_/]+)\\.( |$)")
        set(suite ${CMAKE_MATCH_1})
        add_test("${suite}" "${program}" "--gtest_filter=${suite}.*")
        set_tests_properties("${suite}" PROPERTIES ${properties})
        if(suite MATCHES "Program|Xr|Package|Landmark|Playthrough|FilmDepth|Faults|Fidelity|Numbers|Panorama") # the longest begin first
            set_tests_properties("${suite}" PROPERTIES COST 100)
        endif()
    endif()
endforeach()
