# libwebp with its demultiplexer as target WebP::webpdemux. Debian's package has no CMake files; other package managers
# bring a target of this name.
find_package(WebP CONFIG QUIET)
if(NOT TARGET WebP::webpdemux)
    find_path(TESSERA_WEBP_INCLUDE webp/demux.h REQUIRED DOC "Headers of libwebp (Debian: libwebp-dev)")
    find_library(TESSERA_WEBP_LIBRARY webp REQUIRED DOC "Decodes WebP (Debian: libwebp-dev)")
    find_library(TESSERA_WEBPDEMUX_LIBRARY webpdemux REQUIRED DOC "Finds the frames of WebP files (Debian: libwebp-dev)")
    add_library(WebP::webpdemux INTERFACE IMPORTED)
    set_target_properties(WebP::webpdemux PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${TESSERA_WEBP_INCLUDE}"
        INTERFACE_LINK_LIBRARIES "${TESSERA_WEBPDEMUX_LIBRARY};${TESSERA_WEBP_LIBRARY}")
endif()
