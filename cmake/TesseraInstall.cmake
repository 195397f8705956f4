# cmake --install: the floors' libraries and headers, the program, and what find_package(tessera) needs. Other projects link
# tessera::tessera, which stands for all floors, or a single floor such as tessera::scenes, and include headers by the
# same paths as here ("scenes/Load.h"). Component program is what runs, dev what other programs are built with: a package
# each (packaging/CMakeLists.txt).
include(CMakePackageConfigHelpers)

get_property(floors GLOBAL PROPERTY TESSERA_FLOORS)
add_library(tessera_all INTERFACE)
add_library(tessera::tessera ALIAS tessera_all)
set_target_properties(tessera_all PROPERTIES EXPORT_NAME tessera)
target_link_libraries(tessera_all INTERFACE ${floors})

set(tessera_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
install(TARGETS tessera_all ${floors} EXPORT tesseraTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tessera COMPONENT dev)
install(TARGETS tessera_openimageio LIBRARY DESTINATION ${TESSERA_MODULE_INSTALL_DIR} COMPONENT program)
install(EXPORT tesseraTargets NAMESPACE tessera:: DESTINATION ${tessera_package_dir} COMPONENT dev)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tesseraConfig.cmake.in ${PROJECT_BINARY_DIR}/tesseraConfig.cmake
                              INSTALL_DESTINATION ${tessera_package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tesseraConfig.cmake ${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/TesseraImgui.cmake ${CMAKE_CURRENT_LIST_DIR}/TesseraWebp.cmake
        DESTINATION ${tessera_package_dir} COMPONENT dev)

if(TARGET tessera_program)
    install(TARGETS tessera_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
