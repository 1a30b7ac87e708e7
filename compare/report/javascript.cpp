#include "compare/report/javascript.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// One library: its file, Debian's folder of it, its package, and where its text goes.
struct Place {
  const char *file, *folder, *package;
  std::optional<std::string> Libraries::*text;
};

constexpr std::array<Place, 3> places = {{
    {"d3.min.js", "/usr/share/nodejs/d3/dist", "node-d3", &Libraries::d3},
    {"three.min.js", "/usr/share/javascript/three", "libjs-three", &Libraries::three},
    {"OrbitControls.js", "/usr/share/javascript/three/examples/js/controls", "libjs-three", &Libraries::orbit},
}};

std::optional<std::string> text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

Libraries find_libraries() {
  Libraries libraries;
  const char* own_folder = std::getenv("SOILBIN_JAVASCRIPT");
  for (const Place& place : places) {
    libraries.*place.text = text_of(fs::path(own_folder != nullptr ? own_folder : place.folder) / place.file);
    const bool told = !libraries.missing.empty() && libraries.missing.back() == place.package;
    if (!(libraries.*place.text) && !told) libraries.missing.emplace_back(place.package);
  }
  return libraries;
}

std::string in_script(std::string text) {
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.insert(at + 1, "\\");
  return text;
}

std::string json_in_script(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string script_elements(const Libraries& libraries, bool with_replay) {
  std::string html;
  const auto add = [&](const std::optional<std::string>& text) {
    if (text) html += "<script>\n" + in_script(*text) + "\n</script>\n";
  };
  add(libraries.d3);
  if (with_replay) add(libraries.three), add(libraries.orbit);
  std::string own;
  // 'start.js' comes last: it uses the others.
  for (const bool last : {false, true})
    for (const Script& script : own_scripts())
      if ((script.name == "start.js") == last) own += "// " + script.name + "\n" + script.text;
  return html + "<script>\n" + in_script(own) + "</script>\n";
}

}  // namespace soilbin::compare
