// Settled beds that are kept in a folder and found again by the recipe that made them.
//
//   BedStore beds("beds");
//   const std::shared_ptr<const SettledBed> bed = beds.bed({.soil = grains, .packing = 2});  // settled only once
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "dem/bed/settled_bed.hpp"

namespace soilbin::dem {

/// Sixteen hexadecimal digits that follow from everything in a recipe that the bed depends on, and from the version of
/// the code that makes beds; FNV-1a, 64 bit, over a text of all values in full precision.
std::string content_key(const BedRecipe& recipe);

/// The text behind the key: one line a value.
std::string recipe_text(const BedRecipe& recipe);

class BedStore {
 public:
  /// Beds are kept in memory and, where a folder is given, in files bed-KEY.h5 there.
  explicit BedStore(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  /// The bed of this recipe: from memory, from its file, or settled now. A file whose recipe differs from the one asked
  /// for, or that is damaged, or holds what the recipe can't have given, is settled anew and replaced, and `how` is
  /// told. Of a graded bed `how` is told its zones. A bed that can't be written is told by `how` and used all the same;
  /// so a folder that may only be read serves what is there.
  std::shared_ptr<const SettledBed> bed(const BedRecipe& recipe, const WorkOptions& how = {});

  /// The file of a bed; it exists only if the bed is stored. LAMMPS keeps grains in a folder of their own.
  std::filesystem::path file(const BedRecipe& recipe) const {
    const std::string name = "bed-" + content_key(recipe);
    return recipe.settled_by == SettledBy::lammps ? folder_ / name / "report.txt" : folder_ / (name + ".h5");
  }

 private:
  void keep(const SettledBed& bed, const std::string& text, const WorkOptions& how) const;

  std::filesystem::path folder_;
  std::mutex guard_;
  std::vector<std::pair<std::string, std::shared_ptr<const SettledBed>>> kept_;  ///< by recipe_text
};

}  // namespace soilbin::dem
