// What the server says of a vehicle to a target such as "/vehicle?slope=5deg". Knows nothing of sockets.
#pragma once

#include <string_view>

#include "cli/serve/reply.hpp"
#include "cli/serve/vehicle_setup.hpp"

namespace soilbin::cli {

/// "/": the page. "/case": VehicleSetup::document(). "/vehicle": soilbin-vehicle-answer/1 of the start with the query's
/// flags, "/drive": soilbin-vehicle-drive/1 of it, each with more for the page: command, key figures, sentences and
/// tables as the report has them, curves as a sheet, what a drawing needs. "/state": that alone, of the steady state
/// and the pulls without their errors, while a slider moves. "/vehicle.yaml": the question as a file. "/pulls.csv": the
/// answer's CSV. A vehicle that does not travel, or does not stand at its start, is an answer. Never throws for what a
/// query says; GivenUp where nobody waits.
Reply reply_to(const VehicleSetup& setup, std::string_view target, const StillWanted& wanted);

}  // namespace soilbin::cli
