// Runs the built command and catches what it says.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/folder.hpp"

namespace soilbin::cli::test {

namespace fs = std::filesystem;

/// What a run of the command left behind.
struct Outcome {
  int status = -1;
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Bad input: status 2, no answer, and what standard error tells of it.
MATCHER_P(Refuses, told, "is refused") {
  *result_listener << "status " << arg.status << ": " << arg.err << arg.out;
  return arg.status == 2 && arg.out.empty() && testing::Matches(told)(arg.err);
}

using Scratch = soilbin::test::Folder;

/// Runs 'soilbin <arguments>', quoted as for a shell; `before`: words before it.
inline Outcome soilbin(const std::string& arguments, const std::string& before = "") {
  const Scratch scratch;
  const std::string line = before + "'" SOILBIN_BINARY "' " + arguments + " >'" + (scratch / "out").string() + "' 2>'" +
                           (scratch / "err").string() + "' </dev/null";
  const int raw = std::system(line.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, text_of(scratch / "out"), text_of(scratch / "err")};
}

}  // namespace soilbin::cli::test
