# CPack runs this on the files of each Debian package: what Debian asks for beside them.
get_filename_component(here ${CMAKE_CURRENT_LIST_FILE} DIRECTORY)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  set(name ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(folder ${usr}/share/doc/${name})
  file(COPY ${here}/copyright DESTINATION ${folder})
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH, if that is set
  file(WRITE ${folder}/changelog.Debian
"${name} (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=low

  * What has changed is in CHANGES.md, which comes with the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  file(GLOB documents ${folder}/changelog* ${usr}/share/man/man1/*)
  execute_process(COMMAND gzip -9n ${documents} RESULT_VARIABLE failed)
  file(GLOB libraries ${usr}/lib/*.a ${usr}/lib/*/*.a)
  if(libraries AND NOT failed)
    execute_process(COMMAND strip --strip-unneeded ${libraries} RESULT_VARIABLE failed)
  endif()
  if(failed)
    message(FATAL_ERROR "${name} could not be prepared")
  endif()
endforeach()
