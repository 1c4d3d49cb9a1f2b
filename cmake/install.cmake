# In: the targets sahl and sahl_cli. Out: what `cmake --install` puts where.
# Headers stand under include/sahl/<room>/: users write <sahl/run/run.h>, the headers among themselves "math/vec.h".
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

target_include_directories(sahl INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH from_bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(sahl_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${from_bin_to_lib}")
endif()
install(TARGETS sahl EXPORT sahlTargets FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/sahl")
install(TARGETS sahl_cli)

set(config_folder "${CMAKE_INSTALL_LIBDIR}/cmake/sahl")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/sahlConfig.cmake.in" "${PROJECT_BINARY_DIR}/sahlConfig.cmake"
                              INSTALL_DESTINATION "${config_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/sahlConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(EXPORT sahlTargets NAMESPACE sahl:: DESTINATION "${config_folder}")
install(FILES "${PROJECT_BINARY_DIR}/sahlConfig.cmake" "${PROJECT_BINARY_DIR}/sahlConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/packages.cmake" DESTINATION "${config_folder}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
