# make install, and find_package(wilt) afterwards.
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY WILT_ROOMS)
install(TARGETS ${rooms} EXPORT wiltTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT wiltTargets NAMESPACE wilt:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/wilt)
install(DIRECTORY src/wilt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
configure_package_config_file(cmake/wiltConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/wiltConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/wilt)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/wiltConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/wiltConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/wiltConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/wilt)
