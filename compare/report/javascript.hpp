// What a page inlines: our own scripts and style, which lie in this library, and two libraries that Debian packages,
// read when a page is made.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace soilbin::compare {

/// A file of a folder browser/ that the build put into the program: a script, a style sheet or a piece of HTML.
struct EmbeddedFile {
  std::string name, text;
};

/// The files of compare/report/browser; made by the build.
std::vector<EmbeddedFile> own_files();

/// The text of one of the files. Throws std::out_of_range where there is none of that name.
std::string embedded(const std::vector<EmbeddedFile>& files, const std::string& name);

/// Libraries that a page inlines.
struct Libraries {
  std::optional<std::string> d3;       ///< charts: node-d3, d3.js 5
  std::optional<std::string> three;    ///< the replay in 3D: libjs-three, three.js
  std::optional<std::string> orbit;    ///< its camera by mouse, finger and keys
  std::vector<std::string> missing{};  ///< packages to install for those that are absent
};

/// Read from $SOILBIN_JAVASCRIPT (a folder with d3.min.js, three.min.js, OrbitControls.js), where that is set, else
/// from where Debian's packages put them.
Libraries find_libraries();

/// The scripts of a page as HTML elements: the libraries asked for, then ours.
std::string script_elements(const Libraries& libraries, bool with_replay);

/// Text that may stand in a <script> element: "</" can't end it.
std::string in_script(std::string text);

/// JSON fit to stand in a script element: without a "<", which could begin a comment or an element that hides the rest.
std::string json_in_script(std::string text);

/// Bytes as base64 (RFC 4648), for a script to unpack.
std::string base64(const std::string& bytes);

}  // namespace soilbin::compare
