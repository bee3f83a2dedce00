# SPDX-License-Identifier: MIT
#
# What is installed, and the Debian packages made of it: `btcheck`, the program
# with its page, completions and CMake functions and the observer's headers, which
# needs no other package where it is linked statically, and `libbtcheck-dev`, the library with its
# headers.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The layers in one archive. What they need from outside is linked by who uses
# it, so the options of this build stay here.
add_library(btcheck_library STATIC)
foreach(layer text automata model explore ltl check trace export project report
    settings api)
  target_sources(btcheck_library PRIVATE $<TARGET_OBJECTS:btcheck_${layer}>)
endforeach()
set_target_properties(btcheck_library PROPERTIES
  OUTPUT_NAME btcheck EXPORT_NAME btcheck LINKER_LANGUAGE CXX)
target_include_directories(btcheck_library INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/btcheck>)
target_compile_features(btcheck_library INTERFACE cxx_std_20)
target_link_libraries(btcheck_library INTERFACE
  fmt::fmt TBB::tbb tinyxml2::tinyxml2 SQLite::SQLite3 lz4 Boost::headers
  $<INSTALL_INTERFACE:zstd::libzstd_shared>)

# The same behind the one header for programs that check trees.
add_library(btcheck_door INTERFACE)
set_target_properties(btcheck_door PROPERTIES EXPORT_NAME check)
target_include_directories(btcheck_door INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(btcheck_door INTERFACE cxx_std_20)
target_link_libraries(btcheck_door INTERFACE btcheck_library Threads::Threads)

# The same for C and for languages that call C, as one file to load. Whoever
# loads it need not have what it is made of.
add_library(btcheck_shared SHARED $<TARGET_OBJECTS:btcheck_api>)
set_target_properties(btcheck_shared PROPERTIES OUTPUT_NAME btcheck
  LINKER_LANGUAGE CXX VERSION 1 SOVERSION 1 LINK_DEPENDS
  ${PROJECT_SOURCE_DIR}/cmake/libbtcheck.map)
target_link_libraries(btcheck_shared PRIVATE btcheck_api)
target_link_options(btcheck_shared PRIVATE
  -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/libbtcheck.map)
if(BTCHECK_STATIC)
  target_sources(btcheck_shared PRIVATE cmake/find_object.cpp)
  # Without what nothing calls: a part of libstdc++ wants glibc 2.36.
  target_link_options(btcheck_shared PRIVATE
    -static-libstdc++ -static-libgcc -Wl,--gc-sections -s)
elseif(BTCHECK_SANITIZE)
  set_target_properties(btcheck_shared PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
install(TARGETS btcheck_shared LIBRARY OPTIONAL COMPONENT library
  DESTINATION ${CMAKE_INSTALL_LIBDIR})

# The engine that runs trees, with the one header that its users need.
add_library(btcheck_engine STATIC $<TARGET_OBJECTS:btcheck_run>)
set_target_properties(btcheck_engine PROPERTIES
  OUTPUT_NAME btcheck_run EXPORT_NAME run LINKER_LANGUAGE CXX
  ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/engine)
target_include_directories(btcheck_engine INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(btcheck_engine INTERFACE cxx_std_20)
target_link_libraries(btcheck_engine INTERFACE
  btcheck_library Threads::Threads)

# Rules in a program with BehaviorTree.CPP: headers, which come with the program
# that writes their tables. btcheckConfig adds the engine.
add_library(btcheck_observer INTERFACE)
set_target_properties(btcheck_observer PROPERTIES EXPORT_NAME observer)
target_include_directories(btcheck_observer INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(btcheck_observer INTERFACE cxx_std_17)

# The program writes its own man page and completions; for another machine, one
# that runs here does. Where only a part was
# built, that part is installed: OPTIONAL below leaves the rest out.
set(BTCHECK_WRITER btcheck CACHE STRING "what writes the man page")
set(pages ${PROJECT_BINARY_DIR}/pages)
set(changelog ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
configure_file(cmake/changelog.Debian.in ${pages}/changelog.Debian @ONLY)
add_custom_command(
  OUTPUT ${pages}/btcheck.1.gz ${pages}/btcheck ${pages}/_btcheck
    ${pages}/btcheck.fish ${pages}/licenses.txt ${pages}/changelog.gz
    ${pages}/changelog.Debian.gz
  COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
  COMMAND ${BTCHECK_WRITER} man | gzip -9n > ${pages}/btcheck.1.gz
  COMMAND ${BTCHECK_WRITER} completions bash > ${pages}/btcheck
  COMMAND ${BTCHECK_WRITER} completions zsh > ${pages}/_btcheck
  COMMAND ${BTCHECK_WRITER} completions fish > ${pages}/btcheck.fish
  COMMAND ${BTCHECK_WRITER} --licenses > ${pages}/licenses.txt
  COMMAND gzip -9nc ${changelog} > ${pages}/changelog.gz
  COMMAND gzip -9nc ${pages}/changelog.Debian > ${pages}/changelog.Debian.gz
  DEPENDS ${BTCHECK_WRITER} ${changelog} VERBATIM)
add_custom_target(btcheck_pages ALL DEPENDS ${pages}/btcheck.1.gz btcheck)

# tell_missing(COMPONENT FILE TEXT): said at installation where there is no FILE.
function(tell_missing component file text)
  install(CODE "
    if(NOT EXISTS \"${file}\")
      message(\"-- Left out: ${text}\")
    endif()" COMPONENT ${component})
endfunction()

set(data ${CMAKE_INSTALL_DATADIR})
set_target_properties(btcheck PROPERTIES EXPORT_NAME program)

install(TARGETS btcheck btcheck_observer EXPORT btcheck_program
  COMPONENT program)
install(FILES src/btcheck/observer.hpp src/btcheck/monitor.hpp
  src/btcheck/marked_log.hpp src/btcheck/scripted_suite.hpp
  COMPONENT program DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/btcheck)
if(TARGET btcheck_pins)
  install(TARGETS btcheck_pins LIBRARY OPTIONAL COMPONENT program
    DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(FILES ${pages}/btcheck.1.gz OPTIONAL COMPONENT program
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${pages}/btcheck OPTIONAL COMPONENT program
  DESTINATION ${data}/bash-completion/completions)
install(FILES ${pages}/_btcheck OPTIONAL COMPONENT program
  DESTINATION ${data}/zsh/vendor-completions)
install(FILES ${pages}/btcheck.fish OPTIONAL COMPONENT program
  DESTINATION ${data}/fish/vendor_completions.d)
tell_missing(program ${pages}/btcheck.1.gz
  "no man page, no completions: the target btcheck_pages was not built")
install(DIRECTORY docs examples properties COMPONENT program
  DESTINATION ${data}/doc/btcheck
  PATTERN ".btcheck-results*" EXCLUDE
  PATTERN "__pycache__" EXCLUDE)
install(FILES README.md COMPONENT program DESTINATION ${data}/doc/btcheck)
install(FILES ${pages}/licenses.txt OPTIONAL COMPONENT program
  DESTINATION ${data}/doc/btcheck)
install(DIRECTORY schemas COMPONENT program DESTINATION ${data}/btcheck)
install(DIRECTORY editors/emacs editors/helix editors/neovim
  COMPONENT program DESTINATION ${data}/btcheck/editors)

# A package of Debian has its changelog and licence in a folder of its name.
foreach(package program:btcheck library:libbtcheck-dev)
  string(REPLACE ":" ";" package ${package})
  list(GET package 0 component)
  list(GET package 1 name)
  install(FILES ${pages}/changelog.gz ${pages}/changelog.Debian.gz OPTIONAL
    COMPONENT ${component} DESTINATION ${data}/doc/${name})
  install(FILES cmake/copyright COMPONENT ${component}
    DESTINATION ${data}/doc/${name})
  install(FILES cmake/lintian-overrides RENAME ${name} COMPONENT ${component}
    DESTINATION ${data}/lintian/overrides)
endforeach()

set(library_dir ${CMAKE_INSTALL_LIBDIR}/cmake/btcheck)
set(program_dir ${data}/cmake/btcheck)
install(TARGETS btcheck_library btcheck_door btcheck_engine EXPORT btcheck_library
  COMPONENT library ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} OPTIONAL)
tell_missing(library $<TARGET_FILE:btcheck_engine>
  "no library: the targets btcheck_library and btcheck_engine were not built")
install(FILES src/btcheck/check.h src/btcheck/check.hpp src/btcheck/run.hpp
  COMPONENT library
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/btcheck)
foreach(folder text model explore ltl check trace)
  install(DIRECTORY src/${folder} COMPONENT library
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/btcheck
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(EXPORT btcheck_library FILE btcheckLibrary.cmake NAMESPACE btcheck::
  DESTINATION ${library_dir} COMPONENT library)

configure_package_config_file(cmake/btcheckConfig.cmake.in
  ${pages}/btcheckConfig.cmake INSTALL_DESTINATION ${program_dir}
  PATH_VARS library_dir CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${pages}/btcheckConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(EXPORT btcheck_program FILE btcheckProgram.cmake NAMESPACE btcheck::
  DESTINATION ${program_dir} COMPONENT program)
install(FILES ${pages}/btcheckConfig.cmake ${pages}/btcheckConfigVersion.cmake
  cmake/btcheckTests.cmake DESTINATION ${program_dir} COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME btcheck)
set(CPACK_PACKAGE_VENDOR "the btcheck authors")
set(CPACK_PACKAGE_CONTACT "the btcheck authors <btcheck@localhost>")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE
  OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME btcheck)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "model checker for behavior trees
btcheck tries every combination of action results, sensor values and
interleavings of a behavior tree, and either proves a rule or shows the run
that breaks it.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libbtcheck-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/cmake/triggers)
# The archive was compiled with the headers of these two: what is built with it
# has to have the same ones.
function(same_major variable package version)
  string(REGEX MATCH "^[0-9]+" major ${version})
  math(EXPR next "${major} + 1")
  set(${variable} "${package} (>= ${major}), ${package} (<< ${next})"
    PARENT_SCOPE)
endfunction()
same_major(same_fmt libfmt-dev ${fmt_VERSION})
same_major(same_tinyxml2 libtinyxml2-dev ${tinyxml2_VERSION})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "btcheck (= ${PROJECT_VERSION}-1), libboost-dev, ${same_fmt}, libtbb-dev, libsqlite3-dev, liblz4-dev, ${same_tinyxml2}, libzstd-dev")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "model checker for behavior trees, the library
The layers of btcheck as one static library with headers: reading trees and
properties, searching, replaying, and telling runs; and the engine that runs
trees with leaves of your own.")
include(CPack)
