# Debian's OpenImageIO names include folders of libraries it was built with, which need not be installed here and which its
# headers do not use; CMake refuses to generate with folders that do not exist.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(oiio_existing "")
foreach(folder IN LISTS oiio_includes)
    if(EXISTS "${folder}")
        list(APPEND oiio_existing "${folder}")
    endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_existing}")
