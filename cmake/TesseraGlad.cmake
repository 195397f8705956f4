# Generates the OpenGL 4.5 core loader with glad 2 at configure time (works without a network) as target tessera_glad.
find_program(TESSERA_GLAD glad REQUIRED DOC "glad 2 (Debian: python3-glad)")
set(glad_extensions GL_ARB_polygon_offset_clamp,GL_KHR_debug,GL_KHR_parallel_shader_compile)
# A folder for each list of extensions, so that another list is generated anew.
string(MD5 glad_list ${glad_extensions})
set(glad_dir ${CMAKE_BINARY_DIR}/glad/${glad_list})
if(NOT EXISTS ${glad_dir}/src/gl.c)
    # Debian's script belongs to the system's Python; another interpreter earlier in PATH lacks its modules.
    if(EXISTS /usr/bin/python3 AND TESSERA_GLAD STREQUAL "/usr/bin/glad")
        set(glad_command /usr/bin/python3 ${TESSERA_GLAD})
    else()
        set(glad_command ${TESSERA_GLAD})
    endif()
    execute_process(
        COMMAND ${glad_command} --api gl:core=4.5 --extensions ${glad_extensions} --reproducible
                --out-path ${glad_dir} c
        RESULT_VARIABLE glad_result OUTPUT_VARIABLE glad_output ERROR_VARIABLE glad_output)
    if(NOT glad_result EQUAL 0)
        file(REMOVE ${glad_dir}/src/gl.c)
        message(FATAL_ERROR "glad could not generate the OpenGL loader:\n${glad_output}")
    endif()
endif()
add_library(tessera_glad OBJECT ${glad_dir}/src/gl.c)
target_include_directories(tessera_glad SYSTEM PUBLIC $<BUILD_INTERFACE:${glad_dir}/include>)
