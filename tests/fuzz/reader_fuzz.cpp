// Broken input is refused, never more: whatever the bytes, the readers return or throw InputError with a message,
// within five seconds. Seeds are the files of cases/; each input is a mutated one, made from SEED and its number alone,
// so that a failure can be had again:
//   reader_fuzz SEED COUNT [FIRST]     (default 1 2000 0) inputs FIRST .. FIRST + COUNT - 1; a COUNT of 1 prints the
//   input
// Built with -DSOILBIN_LIBFUZZER and clang's -fsanitize=fuzzer the same target is driven by libFuzzer instead.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/vehicle/vehicle.hpp"
#include "scenario/case.hpp"
#include "scenario/errors.hpp"
#include "scenario/yaml_node.hpp"
#include "tests/scenario/fake_vocabulary.hpp"

namespace {

using soilbin::InputError;
using soilbin::Library;
using soilbin::make_source_text;
using soilbin::test::FakeVocabulary;

constexpr std::string_view cases = SOILBIN_SOURCE_DIR "/cases";
constexpr char campaign_mark = '\x1e';  // splits an input into campaign.yaml and its CSV

std::uint64_t current = 0;  // number of the input, for the message of a failure

/// Ends the program with the reader, the reason and the input's number.
[[noreturn]] void fail(const char* reader, const std::string& reason) {
  std::fprintf(stderr, "reader_fuzz: input %llu: %s: %s\n", static_cast<unsigned long long>(current), reader,
               reason.c_str());
  std::abort();
}

/// Runs a reader; what it reads must survive being written and read again.
void must_answer(const char* reader, const auto& read) {
  constexpr std::chrono::seconds limit(5);  // generous: sanitizers are slow
  const auto begin = std::chrono::steady_clock::now();
  try {
    read();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).empty()) fail(reader, "refused without a message");
  } catch (const std::exception& error) {
    fail(reader, std::string("another exception than InputError: ") + error.what());
  }
  if (std::chrono::steady_clock::now() - begin > limit) fail(reader, "took longer than five seconds");
}

void read_as_case(const std::string& text) {
  const FakeVocabulary effects;
  const Library library({std::filesystem::path(cases)});
  const soilbin::Case value =
      soilbin::parse_case(make_source_text(text, std::string(cases) + "/studies/fuzz.yaml"), library, effects);
  if (value.study.conditions.size() > 1000) return;  // writing a large grid tests nothing new
  const std::string once = soilbin::write_case(value, effects);
  try {
    const soilbin::Case again = soilbin::parse_case(make_source_text(once, "resolved.yaml"), Library(), effects);
    if (soilbin::write_case(again, effects) != once) fail("case", "written and read again, it differs");
  } catch (const InputError& error) {
    fail("case", std::string("can't read what was written: ") + error.what());
  }
}

void read_as_campaign(const std::string& text) {
  const std::size_t mark = text.find(campaign_mark);
  if (mark == std::string::npos) return;
  const auto open = [&](const std::string& name) { return make_source_text(text.substr(mark + 1), name); };
  soilbin::compare::parse_campaign(make_source_text(text.substr(0, mark), "campaign.yaml"), open, Library(),
                                   FakeVocabulary());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  must_answer("case", [&] { read_as_case(text); });
  must_answer("tire", [&] { soilbin::parse_tire(make_source_text(text, "tire.yaml")); });
  must_answer("soil", [&] { soilbin::parse_soil(make_source_text(text, "soil.yaml")); });
  must_answer("SCM soil", [&] { soilbin::parse_soil(make_source_text(text, "soil.json")); });
  must_answer("campaign", [&] { read_as_campaign(text); });
  must_answer("vehicle", [&] {
    soilbin::compare::parse_vehicle_case(make_source_text(text, std::string(cases) + "/vehicles/fuzz.yaml"),
                                         Library({std::filesystem::path(cases)}), FakeVocabulary());
  });
  return 0;
}

#ifndef SOILBIN_LIBFUZZER

namespace {

using Random = std::mt19937_64;

std::vector<std::string> seeds() {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(cases))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> all = {
      R"({"Soil parameters": {"Bekker Kphi": 2e6, "Bekker Kc": 0, "Bekker n exponent": 1.1, "Mohr cohesive limit": 0,
          "Mohr friction limit": 30, "Janosi shear coefficient": 0.01}, // SCM
          "soilbin": {"sd": {"Bekker Kphi": 1e5, "assumed share": 0.1}, "beside SCM": {"density": 1600}}})"};
  for (const fs::path& file : files) {
    std::string text = soilbin::read_source_text(file, soilbin::largest_yaml).text;
    const fs::path csv = file.parent_path() / "runs.csv";
    if (fs::exists(csv)) text += campaign_mark + soilbin::read_source_text(csv, 1U << 20U).text;
    all.push_back(text);
    if (file.parent_path().filename() == "studies")  // the same with tire and soil written out
      all.push_back(soilbin::write_case(soilbin::read_case(file, Library({fs::path(cases)}), FakeVocabulary()),
                                        FakeVocabulary()));
  }
  return all;
}

std::size_t pick(Random& random, std::size_t below) { return below == 0 ? 0 : random() % below; }

const std::vector<std::string> tokens = {"{",
                                         "}",
                                         "[",
                                         "]",
                                         ":",
                                         ": ",
                                         ",",
                                         "- ",
                                         "? ",
                                         "| ",
                                         "> ",
                                         "&a ",
                                         "*a ",
                                         "!!map ",
                                         "!x ",
                                         "%",
                                         "#",
                                         "\"",
                                         "'",
                                         "\n",
                                         "\n  ",
                                         "\t",
                                         "\r\n",
                                         "---\n",
                                         "...\n",
                                         "<<: ",
                                         "~",
                                         "null",
                                         "nan",
                                         ".inf",
                                         "1e999",
                                         "-0",
                                         "0x1",
                                         "1e-320",
                                         "999999999999",
                                         "mm",
                                         "kN/m^(n+1)",
                                         "^(",
                                         "((((",
                                         "deg",
                                         "rpm",
                                         "90 deg",
                                         "-1",
                                         "{from: 0, to: 1, step: 0.1}",
                                         "{value: 1 m, sd: 1 m}",
                                         "\xff",
                                         "\xc3\xa4",
                                         "\xed\xa0\x80",
                                         std::string(1, '\0'),
                                         "\xef\xbb\xbf",
                                         std::string(300, '['),
                                         std::string(300, ' '),
                                         "/dev/zero",
                                         "../../../../etc/passwd",
                                         "a/b.yaml",
                                         "\x1e",
                                         ",,,,",
                                         "\"\"\"",
                                         "lugs",
                                         "effects: [slip_sinkage]"};

/// A piece of one of the seeds.
std::string piece(const std::vector<std::string>& all, Random& random) {
  const std::string& from = all[pick(random, all.size())];
  const std::size_t begin = pick(random, from.size());
  return from.substr(begin, pick(random, 120));
}

void mutate(std::string& text, const std::vector<std::string>& all, Random& random) {
  const std::size_t at = pick(random, text.size() + 1);
  switch (pick(random, 8)) {
    case 0:
      text.insert(at, tokens[pick(random, tokens.size())]);
      break;
    case 1:
      text.erase(at, pick(random, 40));
      break;
    case 2:
      text.insert(at, piece(all, random));
      break;
    case 3:
      if (at < text.size()) text[at] = static_cast<char>(pick(random, 256));
      break;
    case 4:
      if (at < text.size()) text[at] = "0123456789.-eE %:,{}[]\"'\n"[pick(random, 25)];
      break;
    case 5:
      text.resize(at);
      break;
    case 6:
      text.insert(at, text.substr(pick(random, text.size() + 1), pick(random, 200)));
      break;
    default: {
      const std::size_t line = text.find('\n', at);  // a line less
      if (line != std::string::npos) text.erase(line, text.find('\n', line + 1) - line);
    }
  }
}

std::string make_input(const std::vector<std::string>& all, std::uint64_t seed, std::uint64_t number) {
  Random random(seed * 1'000'003 + number);
  std::string text = all[pick(random, all.size())];
  for (std::size_t n = 1 + pick(random, 6); n > 0; --n) mutate(text, all, random);
  return text;
}

void try_input(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, std::uint64_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  const std::uint64_t seed = argument(1, 1), count = argument(2, 2000), first = argument(3, 0);
  const std::vector<std::string> all = seeds();
  for (const std::string& text : all) try_input(text);
  for (current = first; current < first + count; ++current) {
    const std::string text = make_input(all, seed, current);
    if (count == 1) std::fwrite(text.data(), 1, text.size(), stdout);
    if (current % 1000 == 0) std::fprintf(stderr, "input %llu\n", static_cast<unsigned long long>(current));
    try_input(text);
  }
  std::printf("reader_fuzz: %llu inputs from seed %llu: each was read or refused\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(seed));
  return 0;
}

#endif
