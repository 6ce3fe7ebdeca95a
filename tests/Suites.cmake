# Read by ctest before it runs: makes each suite of the GoogleTest program ${program} one test, with ${properties}. A process for each
# case would load libraries and start the graphics driver five times as often.
if(NOT EXISTS "${program}")
    add_test("${program} is not built" "${program}")
    return()
endif()
execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE suites)
string(REGEX REPLACE "\n +[^\n]*" "" suites "${suites}") # the cases
string(REPLACE "\n" ";" suites "${suites}")
foreach(suite ${suites})
    if(suite MATCHES "^([A-Za-z0-9_/]+)\\.( |$)")
        set(suite ${CMAKE_MATCH_1})
        add_test("${suite}" "${program}" "--gtest_filter=${suite}.*")
        set_tests_properties("${suite}" PROPERTIES ${properties})
    endif()
endforeach()
