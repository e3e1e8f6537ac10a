# Copies the library's headers to where other projects see them: all under one name, deliso/, and
# behind it as the sources name them (deliso/mesh/tri_mesh.h of src/, deliso/io/mesh/write_mesh.h,
# deliso/view/trace/trace.h, deliso/c/deliso.h; the driver's are deliso/deliso.h and deliso/options.h), with the
# includes among them to match.
function(deliso_public_headers project generated destination)
  set(source ${project}/src)
  file(GLOB folders RELATIVE ${source} ${source}/*)
  list(REMOVE_ITEM folders deliso)
  list(APPEND folders io view)
  string(REPLACE ";" "|" pattern "${folders}")
  file(GLOB headers ${source}/*/*.h ${generated}/*/*.h ${project}/io/*/*.h ${project}/view/*/*.h
       ${project}/c/deliso.h)
  foreach(header ${headers})
    file(READ ${header} text)
    string(REGEX REPLACE "#include \"(${pattern})/" "#include \"deliso/\\1/" text "${text}")
    set(name ${header})
    foreach(root ${source} ${generated} ${project})
      string(REPLACE "${root}/" "" name ${name})
    endforeach()
    string(REGEX REPLACE "^deliso/" "" name ${name})
    set(old "")
    if(EXISTS ${destination}/deliso/${name})
      file(READ ${destination}/deliso/${name} old)
    endif()
    if(NOT text STREQUAL old)
      file(WRITE ${destination}/deliso/${name} "${text}")
    endif()
  endforeach()
endfunction()
