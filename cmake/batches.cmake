# Translation units of several files: the headers are most of what a file costs to compile.  Files of a batch share
# their unnamed namespaces.  CMake's own unity build writes absolute paths, which keep ccache from sharing objects
# between clones.
set(FEEDHOLD_BATCH 12 CACHE STRING "Files compiled as one (1: each by itself, as clang-tidy and clangd need it)")

set(CMAKE_UNITY_BUILD OFF) # these batches are ours

# feedhold_batches(OUT SOURCES...): what to compile instead of the sources of this folder, given by absolute paths.
function(feedhold_batches out)
  if(FEEDHOLD_BATCH LESS_EQUAL 1)
    set(${out} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(batches "")
  set(includes "")
  set(count 0)
  foreach(source ${ARGN})
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
    string(APPEND includes "#include \"${name}\"\n")
    math(EXPR count "${count} + 1")
    if(count EQUAL FEEDHOLD_BATCH)
      feedhold_write_batch(batches "${includes}")
      set(includes "")
      set(count 0)
    endif()
  endforeach()
  if(includes)
    feedhold_write_batch(batches "${includes}")
  endif()
  set(${out} ${batches} PARENT_SCOPE)
endfunction()

# Appends a file that holds the text to the list of that name; what is there with the same text keeps its time.
function(feedhold_write_batch list_name text)
  list(LENGTH ${list_name} number)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/batches/batch_${number}.cpp)
  file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
  set(${list_name} ${${list_name}} ${file} PARENT_SCOPE)
endfunction()
