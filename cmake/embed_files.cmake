# Writes a C++ file with a function that holds the texts of files of a folder, such as browser/ (compare/report/javascript.hpp).
# cmake -D FILES=a.js;b.css -D NAMESPACE=soilbin::compare -D FUNCTION=own_files -D OUTPUT=file.cpp -P embed_files.cmake
set(text "#include \"compare/report/javascript.hpp\"\n\nnamespace ${NAMESPACE} {\n\n")
string(APPEND text "std::vector<soilbin::compare::EmbeddedFile> ${FUNCTION}() {\n  return {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} content)
  string(APPEND text "      {\"${name}\", R\"text(${content})text\"},\n")
endforeach()
string(APPEND text "  };\n}\n\n}  // namespace ${NAMESPACE}\n")
file(WRITE ${OUTPUT} "${text}")
