#include "cli/commands.hpp"
namespace soilbin::cli { void add_doctor(CLI::App&, Session&) {} }
