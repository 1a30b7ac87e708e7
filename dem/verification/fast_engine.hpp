// The engine under test, as the verification cases start it.
#pragma once

#include <memory>

#include "dem/verification/cases.hpp"

namespace soilbin::dem {

/// Starts a verification case on the fast engine, one thread, on the widest instruction set of the machine.
std::unique_ptr<VerificationEngine> start_fast_engine(const VerificationSetup& setup);

}  // namespace soilbin::dem
