#include "cli/commands.hpp"
namespace soilbin::cli { void add_init(CLI::App&, Session&) {} }
