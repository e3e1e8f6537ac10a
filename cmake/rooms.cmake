# A room is a folder of sources, compiled as one object. The library has the objects of all, the tests
# of a room those of the rooms behind them: `make room` compiles no others.

# Contraction to fused multiply-add would break the exact arithmetic of src/exact, so it is switched
# off, for whoever compiles the headers as well.
add_library(deliso_room INTERFACE)
target_compile_options(deliso_room INTERFACE -ffp-contract=off)
target_include_directories(deliso_room INTERFACE ${DELISO_INCLUDE_DIRS})
target_link_libraries(deliso_room INTERFACE deliso_flags Threads::Threads)

# Adds a target room_NAME for each folder of the patterns that has sources. DELISO_OBJECTS: of all.
macro(add_rooms)
  file(GLOB folders RELATIVE ${PROJECT_SOURCE_DIR} ${ARGN})
  foreach(folder IN LISTS folders)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    if(sources)
      string(REPLACE "/" "_" room room_${folder})
      add_library(${room} OBJECT ${sources})
      target_link_libraries(${room} PRIVATE deliso_room)
      unite(${room})
      list(APPEND DELISO_OBJECTS $<TARGET_OBJECTS:${room}>)
    endif()
  endforeach()
endmacro()

# Sets `result` to the rooms whose headers the files of a folder include, those that these include,
# and so on.
function(rooms_behind result folder)
  set(todo ${folder})
  set(seen ${folder})
  set(rooms "")
  while(todo)
    list(POP_FRONT todo here)
    file(GLOB files ${PROJECT_SOURCE_DIR}/${here}/*.h ${PROJECT_SOURCE_DIR}/${here}/*.cpp)
    foreach(file IN LISTS files)
      file(STRINGS ${file} lines REGEX "^#include \".*/")
      foreach(line IN LISTS lines)
        string(REGEX REPLACE ".*\"(.*)/.*" "\\1" name "${line}")
        foreach(found src/${name} ${name} tests/${name})
          if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${found} AND NOT found IN_LIST seen)
            list(APPEND seen ${found})
            list(APPEND todo ${found})
            string(REPLACE "/" "_" room room_${found})
            if(TARGET ${room})
              list(APPEND rooms ${room})
            endif()
          endif()
        endforeach()
      endforeach()
    endforeach()
  endwhile()
  set(${result} ${rooms} PARENT_SCOPE)
endfunction()
