# Installs the build BUILD_DIR below WORK_DIR, then configures, builds and runs the consumer against it. WORK_DIR starts
# empty, so that leftovers of an earlier install cannot help.
file(REMOVE_RECURSE ${WORK_DIR})

function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message("${output}") # FATAL_ERROR would wrap its lines again
        message(FATAL_ERROR "${what} failed (${result})")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

run("Installing" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run("Configuring the consumer"
    ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK_DIR}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
run("Building the consumer" ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run("The consumer" ${WORK_DIR}/build/consumer)
message("${output}")
if(NOT output MATCHES "lattice: [1-9][0-9]* triangles, 4 lights; [1-9][0-9]* of 64x36 pixels covered")
    message(FATAL_ERROR "The consumer found no triangles, not 4 lights, or drew nothing: see its line above")
endif()

file(GLOB_RECURSE package LIST_DIRECTORIES false ${WORK_DIR}/prefix/*/tessera*.cmake)
if(NOT package)
    message(FATAL_ERROR "No CMake package was installed below ${WORK_DIR}/prefix")
endif()
foreach(file IN LISTS package)
    file(READ ${file} text)
    string(FIND "${text}" "${SOURCE_DIR}" at)
    if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} names the source tree ${SOURCE_DIR}: the package would break when it moves")
    endif()
endforeach()
if(EXISTS ${WORK_DIR}/prefix/bin/tessera)
    run("The installed program" ${WORK_DIR}/prefix/bin/tessera --version)
endif()
