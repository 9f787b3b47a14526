# Packages of a build that is configured for /usr: cpack -G DEB, or cpack -G TGZ. The preset `package` configures one.
set(CPACK_PACKAGE_NAME surehit)
set(CPACK_PACKAGE_CONTACT "The surehit authors <surehit@localhost>" CACHE STRING "Who has made the packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL development)
if(BUILD_SHARED_LIBS)
  list(PREPEND CPACK_COMPONENTS_ALL library)
endif()
# One archive has all. There are two packages, as Debian wants it: programs need the first, and compilers the second.
set(CPACK_ARCHIVE_COMPONENT_INSTALL OFF)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# The name of the package has the major version. The name of the library has all of the interface's version. So a package
# that needs this library says which versions have it: Debian's tools read this from `shlibs`.
set(library_package libsurehit${PROJECT_VERSION_MAJOR})
math(EXPR next_minor "${PROJECT_VERSION_MINOR} + 1")
set(next_interface_version ${PROJECT_VERSION_MAJOR}.${next_minor})
file(CONFIGURE OUTPUT shlibs @ONLY CONTENT "libsurehit @interface_version@ @library_package@ (>= @interface_version@), @library_package@ (<< @next_interface_version@)\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
# CPack adds the scripts that call ldconfig.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/shlibs")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsurehit-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
if(BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", ${library_package} (= ${PROJECT_VERSION})")
else()
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libhwy-dev (>= 1.0)")
endif()

# Debian wants the licence in a form of its own.
file(READ LICENSE license)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]+)\n\n(.*)" ignored "${license}")
set(holder "${CMAKE_MATCH_1}")
string(STRIP "${CMAKE_MATCH_2}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
file(CONFIGURE OUTPUT copyright @ONLY CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: surehit

Files: *
Copyright: @holder@
License: Expat

License: Expat
 @license@
")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/copyright" COMPONENT ${component} EXCLUDE_FROM_ALL
    DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME}")
endforeach()

include(CPack)
