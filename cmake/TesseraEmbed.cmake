# tessera_embed(TARGET NAMESPACE FUNCTION ROOT files...)
#
# Compiles files into TARGET. The generated header "<FUNCTION>.gen.h" declares
#   std::span<const EmbeddedFile> NAMESPACE::FUNCTION();
# whose entries carry each file's path relative to ROOT and its contents. The files become string literals, cut into
# pieces because compilers only promise 64 KiB a literal.
function(tessera_embed target namespace function root)
    set(generated_dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
    set(header ${generated_dir}/${function}.gen.h)
    set(source ${generated_dir}/${function}.gen.cpp)
    file(CONFIGURE OUTPUT ${header} @ONLY CONTENT [[#pragma once
#include <span>
#include <string_view>
namespace @namespace@ {
struct EmbeddedFile {
    std::string_view path;
    std::string_view text;
};
std::span<const EmbeddedFile> @function@();
} // namespace @namespace@
]])
    string(REPLACE ";" "|" file_list "${ARGN}")
    add_custom_command(
        OUTPUT ${source}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${source} -DNAMESPACE=${namespace} -DFUNCTION=${function} -DROOT=${root}
                "-DFILES=${file_list}" -P ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake
        DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake
        VERBATIM)
    target_sources(${target} PRIVATE ${source})
    target_include_directories(${target} PRIVATE ${generated_dir})
endfunction()
