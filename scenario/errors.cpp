#include "scenario/errors.hpp"

#include <fmt/core.h>

namespace soilbin {
namespace {

std::string describe(const SourcePosition& at, const std::string& message, const std::string& excerpt,
                     const std::string& hint) {
  std::string text = at.file;
  if (at.line > 0) text += fmt::format(":{}", at.line);
  if (at.line > 0 && at.column > 0) text += fmt::format(":{}", at.column);
  text += fmt::format(": {}", message);
  if (!excerpt.empty()) text += fmt::format("\n{}", excerpt);
  if (!hint.empty()) text += fmt::format("\n  hint: {}", hint);
  return text;
}

}  // namespace

InputError::InputError(const SourcePosition& at, const std::string& message, const std::string& excerpt,
                       const std::string& hint)
    : std::runtime_error(describe(at, message, excerpt, hint)), position_(at) {}

}  // namespace soilbin
