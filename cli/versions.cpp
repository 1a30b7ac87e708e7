#include "cli/versions.hpp"

#include <fmt/core.h>

#include <source_state.hpp>

namespace soilbin::cli {

std::string source_state() { return SOILBIN_SOURCE_STATE; }

std::string version_line() {
  const std::string state = source_state();
  return fmt::format("soilbin {} ({}{}, {}, {})", SOILBIN_VERSION, state.starts_with("release") ? "" : "commit ", state,
                     SOILBIN_BUILD_TYPE, SOILBIN_COMPILER);
}

std::vector<std::pair<std::string, std::string>> versions() {
  return {
      {"soilbin", SOILBIN_VERSION},    {"build", SOILBIN_BUILD_TYPE},          {"compiler", SOILBIN_COMPILER},
      {"GSL", SOILBIN_GSL_VERSION},    {"SUNDIALS", SOILBIN_SUNDIALS_VERSION}, {"yaml-cpp", SOILBIN_YAML_CPP_VERSION},
      {"fmt", SOILBIN_FMT_VERSION},    {"Eigen", SOILBIN_EIGEN_VERSION},       {"nlohmann-json", SOILBIN_JSON_VERSION},
      {"CLI11", SOILBIN_CLI11_VERSION}};
}

}  // namespace soilbin::cli
