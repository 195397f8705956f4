# tessera_floor(NAME [WITHOUT folder] [PUBLIC targets...] [PRIVATE targets...])
#
# One library for one floor of the house: every .cpp below the calling folder but those in WITHOUT, with its headers as an
# installable file set. Headers are included by their path from the repository root ("scenes/Scene.h"), installed and not.
function(tessera_floor name)
    cmake_parse_arguments(FLOOR "" "WITHOUT" "PUBLIC;PRIVATE" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    if(FLOOR_WITHOUT)
        list(FILTER sources EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${FLOOR_WITHOUT}/")
    endif()
    file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
    if(NOT sources) # a floor that so far holds headers only
        file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
        set(sources ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    endif()
    add_library(tessera_${name} STATIC ${sources})
    add_library(tessera::${name} ALIAS tessera_${name})
    set_target_properties(tessera_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX
                                                     VERIFY_INTERFACE_HEADER_SETS ${TESSERA_TESTS})
    target_sources(tessera_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
    target_link_libraries(tessera_${name} PUBLIC ${FLOOR_PUBLIC} PRIVATE ${FLOOR_PRIVATE})
    tessera_compile_options(tessera_${name})
    set_property(GLOBAL APPEND PROPERTY TESSERA_FLOORS tessera_${name})
endfunction()

# The language level, warnings and sanitizers that every target of the project is built with.
function(tessera_compile_options target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    # Clang's -Wshadow would name what other sources of a batch define in anonymous namespaces. Without contraction the CPU's
    # sums do not depend on which multiply-adds a compiler happens to fuse.
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic $<$<CXX_COMPILER_ID:GNU>:-Wshadow> -ffp-contract=off)
    # GCC 12 vectorises double(float(x)), x double, of neighbouring values into x itself: the rounding to single is lost.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
    # GCC spends a fifth of a large piece's time on collecting garbage that fits into memory: 1.4 GB a piece.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=2097152>)
    if(TESSERA_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(TESSERA_FUZZ)
        target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
    if(TESSERA_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
        target_link_options(${target} PRIVATE -fsanitize=address,undefined)
        # The sanitizer opens modules in the program's name, so that only the program's own kind of run path counts.
        target_link_options(${target} PRIVATE -Wl,--disable-new-dtags)
        # With sanitizers GCC 12 takes members of std::regex's own states for uninitialised (GCC bug 105562).
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    endif()
endfunction()

set(TESSERA_LIGHT_FLAGS "" CACHE STRING "Compiler flags of what never computes for long: viewer, program and tests")

# For targets that never compute for long.
function(tessera_light_options target)
    target_compile_options(${target} PRIVATE ${TESSERA_LIGHT_FLAGS})
    if(TESSERA_LIGHT_FLAGS MATCHES "-Og") # with which GCC 12 takes members of std::stop_callback for uninitialised
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    endif()
endfunction()
