#include "compare/sweep/alike.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/description.hpp"

namespace soilbin::compare {
namespace {

/// The visitor of OperatingCondition's description that compares member by member.
class Agreement {
 public:
  using C = OperatingCondition;
  Agreement(const C& a, const C& b) : a_(a), b_(b) {}
  bool agree = true;

  void number(const char*, double C::*member, const Measure&, Need, const char*) { near(a_.*member, b_.*member); }
  void number(const char*, std::optional<double> C::*member, const Measure&, Need, const char*) {
    agree = agree && (a_.*member).has_value() == (b_.*member).has_value();
    near((a_.*member).value_or(0.0), (b_.*member).value_or(0.0));
  }
  template <class N>
  void integer(const char*, N C::*member, int, Need, const char*) {
    agree = agree && a_.*member == b_.*member;
  }
  template <class E>
  void choice(const char*, E C::*member, Need, const char*) {
    agree = agree && a_.*member == b_.*member;
  }

 private:
  void near(double x, double y) { agree = agree && std::abs(x - y) <= 1e-9 * std::max(std::abs(x), std::abs(y)); }

  const C& a_;
  const C& b_;
};

}  // namespace

bool alike(const OperatingCondition& a, const OperatingCondition& b) {
  Agreement visitor(a, b);
  describe(visitor, std::type_identity<OperatingCondition>{});
  return visitor.agree;
}

}  // namespace soilbin::compare
