// soilbin doctor: what this program was built from, where its library is, and whether the wheel still computes right.
#include <fmt/core.h>

#include <memory>

#include "bekker_wong/agreed_points.hpp"
#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/versions.hpp"

namespace soilbin::cli {
namespace {

int doctor(bool json, const Session& session) {
  const Library& library = session.place.library;
  nlohmann::ordered_json document = {{"format", "soilbin-doctor/1"}};
  for (const auto& [name, version] : versions()) document["versions"][name] = version;
  document["library"] = nlohmann::ordered_json::array();
  for (const auto& folder : session.place.folders) document["library"].push_back(folder.string());
  std::string text;
  for (const auto& [name, version] : versions()) text += fmt::format("  {:<14}{}\n", name, version);
  text += "\nLibrary of cases (searched in this order; $SOILBIN_CASES goes first)\n";
  for (const auto& folder : session.place.folders) text += "  " + folder.string() + "\n";
  bool well = !session.place.folders.empty();
  if (!well) text += "  not found: set SOILBIN_CASES to a folder with tires/, soils/ and studies/\n";
  for (const Shelf shelf : all_shelves) text += fmt::format("  {} {}\n", library.names(shelf).size(), folder_of(shelf));
  text += "\nSelf-test: wheels that two independent codes compute alike, to the last digit shown\n";
  for (const bekker_wong::AgreedPoint& point : bekker_wong::agreed_points()) {
    const double off = worst_difference(point, reading_at(point));
    const bool pass = off <= 1.0;
    well = well && pass;
    text += fmt::format("  {}  {}{} (differs by {:.2f} of what rounding allows)\n", pass ? "pass" : "FAIL", point.name,
                        point.published.empty() ? "" : ", " + point.published, off);
    document["self_test"].push_back(
        {{"name", point.name}, {"published", point.published}, {"difference_over_rounding", off}, {"pass", pass}});
  }
  document["well"] = well;
  if (json)
    print_json(document);
  else
    fmt::print("{}\n{}\n", text, well ? "All is well." : "Something is wrong: see above.");
  return well ? done : failed;
}

}  // namespace

void add_doctor(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("doctor", "versions, where the library is, and a self-test");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  command->callback([=, &session] { session.action = [=, &session] { return doctor(*json, session); }; });
}

}  // namespace soilbin::cli
