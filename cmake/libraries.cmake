# A library is one folder and one static library.  `DEPS` names the libraries above it that it uses, so that the link
# line says the same as .ci/layers.txt; `PRIVATE` names libraries that only its .cpp files see;
# `EXCEPT` files whose twins take their place in this build.

add_library(feedhold_options INTERFACE)
target_compile_options(feedhold_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wswitch-enum -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False on std::string and std::optional at some levels of optimisation (GCC bugs 105651, 105562, 107852).
  target_compile_options(feedhold_options INTERFACE -Wno-restrict -Wno-maybe-uninitialized -Wno-array-bounds
                         -Wno-stringop-overflow)
endif()
target_include_directories(feedhold_options INTERFACE ${PROJECT_SOURCE_DIR}/analyzer ${PROJECT_SOURCE_DIR})
if(ALLOCATOR_LIBRARY)
  target_link_libraries(feedhold_options INTERFACE ${ALLOCATOR_LIBRARY})
endif()
if(FEEDHOLD_SANITIZE)
  target_compile_options(feedhold_options INTERFACE -fsanitize=${FEEDHOLD_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(feedhold_options INTERFACE -fsanitize=${FEEDHOLD_SANITIZE})
endif()

# feedhold_sources(OUT): the .cpp files of this folder, without those of another system (`NAME_windows.cpp`).
function(feedhold_sources out)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(WIN32)
    list(FILTER sources EXCLUDE REGEX "_posix\\.cpp$")
  else()
    list(FILTER sources EXCLUDE REGEX "_windows\\.cpp$")
  endif()
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

function(feedhold_library name)
  cmake_parse_arguments(LIBRARY "" "" "DEPS;PRIVATE;EXCEPT" ${ARGN})
  feedhold_sources(sources)
  foreach(file ${LIBRARY_EXCEPT})
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  if(sources)
    feedhold_batches(batches ${sources})
    add_library(${name} STATIC ${batches})
    target_link_libraries(${name} PUBLIC feedhold_options ${LIBRARY_DEPS} PRIVATE ${LIBRARY_PRIVATE})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE feedhold_options ${LIBRARY_DEPS})
  endif()
endfunction()
