// Functions over all nodes of a contact at once: the arithmetic that the model spends its time in.
// Own polynomials rather than libm's scalar calls, so that the compiler can take 2, 4 or 8 nodes at a time. Only IEEE
// add, multiply, divide and square root are used, never contracted into fused multiply-adds, so the answer is the same
// to the last bit on every x86-64 machine, however many nodes it takes at a time, and for any number of threads.
#pragma once

#include <span>

namespace soilbin::bekker_wong {

/// sine = sin(angle/2), cosine = cos(angle/2) for |angle| <= 3.2 rad, to 3e-16 absolute.
void half_angle(std::span<const double> angle, std::span<double> sine, std::span<double> cosine);

/// out = scale * base^exponent, 0 where base <= 0, NaN where base is not a number or infinite.
/// Relative error below 1e-15 * (2 + |exponent ln(base)|); base a normal number, a result below 1e-307 may be 0.
void scaled_power(std::span<const double> base, double exponent, double scale, std::span<double> out);

/// out = 1 - exp(-displacement/modulus) for displacement >= 0, modulus > 0, to 5e-16 relative (Janosi and Hanamoto
/// 1961).
void mobilised_share(std::span<const double> displacement, std::span<const double> modulus, std::span<double> out);

/// out = sqrt(x^2 + y^2).
void length(std::span<const double> x, std::span<const double> y, std::span<double> out);

}  // namespace soilbin::bekker_wong
