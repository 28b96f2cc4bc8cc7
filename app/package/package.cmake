# What a desktop and a shell know of the program, and the Debian package of it (tests/run --package): the program alone;
# the C++ libraries are for app/install.
set(here ${CMAKE_CURRENT_LIST_DIR})
set(declared ${PROJECT_BINARY_DIR}/declared)
file(MAKE_DIRECTORY ${declared})
add_custom_command(TARGET nextview POST_BUILD VERBATIM
  COMMAND nextview help --man > ${declared}/nextview.1
  COMMAND nextview help --completion > ${declared}/nextview.bash)
add_custom_target(package_documents
  COMMAND gzip -9nk -f ${declared}/nextview.1
  COMMAND ${here}/make-sbom ${PROJECT_BINARY_DIR} ${PROJECT_VERSION} > ${declared}/nextview.spdx.json
  DEPENDS nextview nextview_headless_gl VERBATIM)
if(NOT NEXTVIEW_INSTALL)
  return()
endif()

install(FILES ${here}/nextview.desktop ${here}/nextview-demo.desktop DESTINATION share/applications COMPONENT program)
install(FILES ${here}/nextview.xml DESTINATION share/mime/packages COMPONENT program)
install(FILES ${here}/icons/nextview.svg DESTINATION share/icons/hicolor/scalable/apps COMPONENT program)
foreach(size 48 128)
  install(FILES ${here}/icons/nextview-${size}.png DESTINATION share/icons/hicolor/${size}x${size}/apps RENAME nextview.png COMPONENT program)
endforeach()
install(FILES ${declared}/nextview.bash DESTINATION share/bash-completion/completions RENAME nextview COMPONENT program)
install(FILES ${declared}/nextview.1.gz DESTINATION share/man/man1 COMPONENT documents EXCLUDE_FROM_ALL)
install(FILES ${declared}/nextview.1 DESTINATION share/man/man1)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/nextview RENAME copyright COMPONENT documents EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/SECURITY.md ${declared}/nextview.spdx.json
        DESTINATION share/doc/nextview COMPONENT documents EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program documents)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_NAME nextview)
set(CPACK_PACKAGE_CONTACT "Nextview's maintainers <maintainers@nextview.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "next-best-view planning for 3D scanning")
set(CPACK_PACKAGE_DESCRIPTION "Decides where a scanner should look next, and shows why: scans an object view by view with a
simulated, recorded or real depth camera, in a window or without one.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "occt-misc, glmark2-data, fonts-inter, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, python3")
include(CPack)
