// What a folder of the library holds, in sections and with a line on each name, as its contents.yaml says:
//
//   format: soilbin-contents/1
//   tires:
//     Wheels of planetary rovers:
//       curiosity: Mars rover Curiosity
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenario/library.hpp"

namespace soilbin {

struct ContentsLine {
  std::string name;
  std::string meaning;  ///< what it is, in a line; empty where contents.yaml has none
};

struct ContentsSection {
  std::string title;
  std::vector<ContentsLine> lines;
};

/// The names of a shelf, each once, in the order of the folders' contents.yaml; those that none of them lists come
/// last, in a section "Others". Names that are listed and aren't there are left out. Throws InputError for a file that
/// can't be read.
std::vector<ContentsSection> contents_of(const std::vector<std::filesystem::path>& folders, Shelf shelf);

}  // namespace soilbin
