# One target per room: wilt_room(NAME SOURCES a.cpp ... ROOMS core mesh ... LIBRARIES fmt::fmt-header-only ...)
# ROOMS are the rooms that its public headers include; LIBRARIES are private to its sources.
add_library(wilt_options INTERFACE)
# No contraction: the same bytes on every processor of one class. No errno from sqrt, which would keep it out of
# vectors. Vectors never cross a function that is not inlined, so their calling convention does not matter.
target_compile_options(wilt_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -ffp-contract=off -fno-math-errno -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees uninitialised members in Eigen's and svgpp's inlined code where there are none.
  target_compile_options(wilt_options INTERFACE -Wno-maybe-uninitialized)
endif()
if(WILT_WERROR)
  target_compile_options(wilt_options INTERFACE -Werror)
endif()
# What it costs: docs/performance.md. Not for browsers, which confine the program themselves, nor beside sanitizers, which
# find more, and have _GLIBCXX_ASSERTIONS: geodesics take 80 % more instructions with it.
option(WILT_HARDENING "Stack protector, checks of library calls, read-only relocations" ON)
if(WILT_HARDENING AND NOT EMSCRIPTEN AND NOT WILT_SANITIZE)
  target_compile_options(wilt_options INTERFACE -fstack-protector-strong -fstack-clash-protection
    $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(wilt_options INTERFACE -fcf-protection)
  endif()
  target_link_options(wilt_options INTERFACE -Wl,-z,relro,-z,now)
endif()
if(WILT_SANITIZE)
  target_compile_options(wilt_options INTERFACE -fsanitize=${WILT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    -D_GLIBCXX_ASSERTIONS)
  target_link_options(wilt_options INTERFACE -fsanitize=${WILT_SANITIZE})
endif()

function(wilt_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  add_library(wilt_${name} STATIC ${ROOM_SOURCES})
  add_library(wilt::${name} ALIAS wilt_${name})
  set_target_properties(wilt_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(wilt_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(wilt_${name} PUBLIC cxx_std_20)
  list(TRANSFORM ROOM_ROOMS PREPEND wilt::)
  target_link_libraries(wilt_${name} PUBLIC Eigen3::Eigen ${ROOM_ROOMS}
    PRIVATE $<BUILD_INTERFACE:wilt_options> ${ROOM_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY WILT_ROOMS wilt_${name})
endfunction()
