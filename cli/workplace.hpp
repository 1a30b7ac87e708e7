// Where the command finds its library of cases.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/measured/campaign.hpp"
#include "scenario/case.hpp"

namespace soilbin::cli {

/// Folders of cases, in the order in which they are searched, and the words that files may use.
struct Workplace {
  std::vector<std::filesystem::path> folders;
  Library library;
  bekker_wong::CatalogueVocabulary effects;
};

/// The file of the command that runs. Throws fs::filesystem_error where the system does not tell it.
std::filesystem::path this_program();

/// Searches $SOILBIN_CASES (folders separated by ':'), then ../share/soilbin/cases beside the program, then the source
/// tree that the program was built from.
Workplace find_workplace();

/// The JSON Schema of a file format ("case", "tire", ...) as a file, installed or of this build; no value where it was
/// not written.
std::optional<std::filesystem::path> schema_file(const std::string& format);

/// The `format:` of a YAML document, "" where there is none. Throws InputError for a file that is no such document.
std::string format_of(const std::filesystem::path& file);

/// Whether a name is a vehicle's: of the library, where no study has it, or a file that says so.
bool names_a_vehicle(const Workplace& place, const std::string& name);

/// Reads a case: the name of a study in the library, or a path.
Case find_case(const Workplace& place, const std::string& name);

/// Finds a study; refuses a case that asks for a drive alone.
Case find_study(const Workplace& place, const std::string& name);

/// Where the record of a study's runs lies, beside it in the library, or would: recorded/NAME.json.
std::filesystem::path place_of_record(const Workplace& place, const std::string& study);
/// The record of a study's runs that lies beside it in the library. Throws InputError with a hint where there is none.
std::filesystem::path find_record(const Workplace& place, const std::string& study);
/// The record that an option's value, `recorded`, names. library_record: this study's. A name, neither a path nor
/// NAME.json: the record of that study. Else the file `recorded` itself.
std::filesystem::path find_record(const Workplace& place, const std::string& study, const std::string& recorded);
inline constexpr const char* library_record = "library";

/// Reads a campaign: a name of the library, its folder, or its campaign.yaml.
compare::Campaign find_campaign(const Workplace& place, const std::string& name,
                                compare::CampaignUse use = compare::CampaignUse::prediction);

/// The columns that such a campaign declares, by quantity; its rows are not read.
std::map<std::string, compare::DataColumn> declared_columns(const Workplace& place, const std::string& name);

/// $XDG_CACHE_HOME/soilbin, else .cache/soilbin in the user's home; empty where there is no home. As the XDG Base
/// Directory Specification asks, an XDG_CACHE_HOME that is empty or no absolute path counts as not set.
std::filesystem::path user_cache();

}  // namespace soilbin::cli
