// The errors of the library as exceptions. The command turns InputError into exit status 2 and every other error
// into 1.
//
//   try {
//     model.evaluate(scenario, at);
//   } catch (const InputError& error) {  // the question makes no sense
//     fmt::print("{} (line {})\n", error.what(), error.position().line);
//   } catch (const NoSolution& error) {  // the soil does not carry this wheel
//     fmt::print("{}\n", error.what());
//   }
#pragma once

#include <stdexcept>
#include <string>

namespace soilbin {

/// A place in a file that a person wrote. Lines and columns count from 1; 0 means "the file as a whole".
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Input that is refused. what() reads "file:line:column: message", then an excerpt and a hint where there are any.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const SourcePosition& at, const std::string& message, const std::string& excerpt = "",
             const std::string& hint = "");
  const SourcePosition& position() const { return position_; }

 private:
  SourcePosition position_;
};

/// A question that the model has no answer to: the wheel would bury itself, or no sinkage carries the load.
/// what() says which and by how much. Never answered with a zero.
class NoSolution : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace soilbin
