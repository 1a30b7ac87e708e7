#include "compare/report/javascript.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// One library: its file, Debian's folder of it, its package, and where its text goes.
struct PlaceOfLibrary {
  const char *file, *folder, *package;
  std::optional<std::string> Libraries::*text;
};

constexpr std::array<PlaceOfLibrary, 3> places = {{
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

std::string embedded(const std::vector<EmbeddedFile>& files, const std::string& name) {
  for (const EmbeddedFile& file : files)
    if (file.name == name) return file.text;
  throw std::out_of_range("no file " + name + " in the program");
}

Libraries find_libraries() {
  Libraries libraries;
  const char* own_folder = std::getenv("SOILBIN_JAVASCRIPT");
  for (const PlaceOfLibrary& place : places) {
    libraries.*place.text = text_of(fs::path(own_folder != nullptr ? own_folder : place.folder) / place.file);
    const bool listed = !libraries.missing.empty() && libraries.missing.back() == place.package;
    if (!(libraries.*place.text) && !listed) libraries.missing.emplace_back(place.package);
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
    for (const EmbeddedFile& script : own_files())
      if (script.name.ends_with(".js") && (script.name == "start.js") == last)
        own += "// " + script.name + "\n" + script.text;
  return html + "<script>\n" + in_script(own) + "</script>\n";
}

std::string base64(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? letters[(three >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

}  // namespace soilbin::compare
