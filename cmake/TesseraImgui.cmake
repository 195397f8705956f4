# Dear ImGui with its backends for GLFW and OpenGL 3 as target imgui::imgui. Debian's package has no CMake files and needs
# libstb at link time; other package managers bring a target of this name.
find_package(imgui CONFIG QUIET)
if(NOT TARGET imgui::imgui)
    find_path(TESSERA_IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED DOC "Headers of Dear ImGui (Debian: libimgui-dev)")
    find_path(TESSERA_IMGUI_BACKENDS imgui_impl_glfw.h HINTS ${TESSERA_IMGUI_INCLUDE} PATH_SUFFIXES backends REQUIRED
              DOC "Headers of Dear ImGui's backends (Debian: libimgui-dev)")
    find_library(TESSERA_IMGUI_LIBRARY imgui REQUIRED DOC "Dear ImGui with its backends (Debian: libimgui-dev)")
    find_library(TESSERA_STB_LIBRARY stb REQUIRED DOC "What Debian's Dear ImGui is linked with (Debian: libstb-dev)")
    add_library(imgui::imgui INTERFACE IMPORTED)
    set_target_properties(imgui::imgui PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${TESSERA_IMGUI_INCLUDE};${TESSERA_IMGUI_BACKENDS}"
        INTERFACE_LINK_LIBRARIES "${TESSERA_IMGUI_LIBRARY};${TESSERA_STB_LIBRARY};glfw;${CMAKE_DL_LIBS}")
endif()
