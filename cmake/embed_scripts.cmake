# Writes a C++ file with a function that holds the scripts' texts: compare/report/javascript.hpp tells what for.
# cmake -D SCRIPTS=a.js;b.js -D NAMESPACE=soilbin::compare -D FUNCTION=own_scripts -D OUTPUT=file.cpp -P embed_scripts.cmake
set(text "#include \"compare/report/javascript.hpp\"\n\nnamespace ${NAMESPACE} {\n\n")
string(APPEND text "std::vector<soilbin::compare::Script> ${FUNCTION}() {\n  return {\n")
foreach(script IN LISTS SCRIPTS)
  get_filename_component(name ${script} NAME)
  file(READ ${script} content)
  string(APPEND text "      {\"${name}\", R\"script(${content})script\"},\n")
endforeach()
string(APPEND text "  };\n}\n\n}  // namespace ${NAMESPACE}\n")
file(WRITE ${OUTPUT} "${text}")
