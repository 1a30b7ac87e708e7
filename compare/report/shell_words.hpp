// Words of a command line as a shell reads them back: shell_words({"run", "my case"}) is "run 'my case'".
#pragma once

#include <string>
#include <vector>

namespace soilbin::compare {

/// The words with a blank between them, on one line; those that a shell (bash) would take apart are quoted.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace soilbin::compare
