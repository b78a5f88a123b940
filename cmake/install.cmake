# cmake --install and the Debian package. The program itself writes the man page and the shell completions.
include(GNUInstallDirs)

# Installing and packing first build what is installed, and no tests, which the target `all` contains.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${CMAKE_BINARY_DIR}\" --target cicatrix cicatrix-head documents COMMAND_ERROR_IS_FATAL ANY)")

set(documents ${CMAKE_BINARY_DIR}/documents)
set(document_files)
function(cicatrix_document kind name folder)
    add_custom_command(
        OUTPUT ${documents}/${name}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${documents}
        COMMAND cicatrix document ${kind} > ${documents}/${name}
        DEPENDS cicatrix
        COMMENT "Writing ${name}"
        VERBATIM)
    install(FILES ${documents}/${name} DESTINATION ${folder})
    set(document_files ${document_files} ${documents}/${name} PARENT_SCOPE)
endfunction()
cicatrix_document(man cicatrix.1 ${CMAKE_INSTALL_MANDIR}/man1)
cicatrix_document(bash cicatrix ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
cicatrix_document(zsh _cicatrix ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
cicatrix_document(fish cicatrix.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# Debian's copyright file, from LICENSE, whose third line names the holders.
set(license ${CMAKE_SOURCE_DIR}/LICENSE)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${license})
file(READ ${license} license_text)
string(REGEX REPLACE "^MIT License\n\nCopyright \\(c\\) ([^\n]*)\n\n(.*)\n$" "\\1;\\2" license_text "${license_text}")
list(POP_FRONT license_text holders)
string(REGEX REPLACE "\n\n" "\n.\n" license_text "${license_text}")
string(REGEX REPLACE "\n" "\n " license_text "${license_text}")
file(CONFIGURE OUTPUT ${documents}/copyright CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Cicatrix
Comment: The default head is not part of this package. cicatrix-fetch-head makes it from MakeHuman's figure and skin (CC0).

Files: *
Copyright: @holders@
License: Expat
 @license_text@
" @ONLY)
add_custom_command(
    OUTPUT ${documents}/changelog.gz
    COMMAND ${CMAKE_COMMAND} -E make_directory ${documents}
    COMMAND gzip -9 -n -c ${CMAKE_SOURCE_DIR}/cmake/packaging/changelog > ${documents}/changelog.gz
    DEPENDS ${CMAKE_SOURCE_DIR}/cmake/packaging/changelog
    VERBATIM)
add_custom_target(documents ALL DEPENDS ${document_files} ${documents}/changelog.gz)

install(TARGETS cicatrix cicatrix-head RUNTIME)
install(PROGRAMS tools/head/cicatrix-fetch-head TYPE BIN)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/cicatrix)
install(FILES cmake/packaging/cicatrix.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES cmake/packaging/localhost.cicatrix.cicatrix.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES cmake/packaging/cicatrix.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff ${documents}/copyright ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Cicatrix authors <cicatrix@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libvulkan1) # loaded at run time, so shlibdeps cannot find it
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, ffmpeg")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "npm, ca-certificates") # to fetch the default head
include(CPack)
