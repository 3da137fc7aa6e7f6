# Compile options shared by every target of the project; nothing here leaks into a project that embeds it.
function(hexwright_target_options target)
  # -ffp-contract=off: a fused multiply-add would make results depend on the processor.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off)
  if(HEXWRIGHT_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(HEXWRIGHT_ASSERTS)
    target_compile_definitions(${target} PRIVATE HEXWRIGHT_ASSERTS=1)
  endif()
  if(HEXWRIGHT_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${HEXWRIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${HEXWRIGHT_SANITIZE})
  endif()
endfunction()

# hexwright_test(<name> <source>...): one test program of GoogleTest cases, found by CTest case by case.
function(hexwright_test name)
  add_executable(${name} ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE hexwright::hexwright fmt::fmt nlohmann_json::nlohmann_json
    GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE HEXWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  hexwright_target_options(${name})
  # The time of a test is spent in the library; optimising the tests themselves only costs build time.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 600)
endfunction()
