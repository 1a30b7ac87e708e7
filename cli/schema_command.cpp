#include "cli/commands.hpp"
namespace soilbin::cli { void add_schema(CLI::App&, Session&) {} }
