#include "compare/bevameter/loading_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace soilbin::compare {
namespace {

/// A spike stands this many median steps of its neighbours off them [-]: of normal noise none does. Chosen.
constexpr double steps_of_a_spike = 10.0;
/// And by at least this share of them [-]. Chosen: smaller ones move no fit.
constexpr double least_spike = 0.02;
constexpr std::size_t longest_spike = 3, steps_nearby = 5;

double middle_value(std::span<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Numbers in the order in which they were read, without those set aside.
struct LiveSeries {
  const std::vector<double>& all;
  const std::vector<std::size_t>& live;
  std::size_t size() const { return live.size(); }
  double operator[](std::size_t i) const { return all[live[i]]; }

  /// Median of the steps between the readings nearest to first .. last, of up to five on each side.
  double step_near(std::size_t first, std::size_t last) const {
    std::array<double, 2 * steps_nearby> steps{};
    std::size_t count = 0;
    for (std::size_t i = first; i-- > 1 && count < steps_nearby;)
      steps[count++] = std::abs((*this)[i] - (*this)[i - 1]);
    const std::size_t before = count;
    for (std::size_t i = last + 2; i < size() && count < before + steps_nearby; ++i)
      steps[count++] = std::abs((*this)[i] - (*this)[i - 1]);
    return middle_value(std::span(steps).first(count));
  }
};

/// Readings first .. last of a series, and how far they stand off both neighbours: above 0, or below.
struct SpikeBlock {
  std::size_t first = 0, last = 0;
  double off = 0.0;
};

/// How far this block stands off the readings before and behind, where it is a spike: all of it on one side, and the
/// series goes on where it was.
SpikeBlock spike_at(const LiveSeries& x, std::size_t first, std::size_t last, double share_of) {
  const double before = x[first - 1], behind = x[last + 1], low = std::min(before, behind),
               high = std::max(before, behind);
  double above = std::numeric_limits<double>::infinity(), below = above;
  for (std::size_t i = first; i <= last; ++i) above = std::min(above, x[i] - high), below = std::min(below, low - x[i]);
  const double off = std::max(above, below);
  if (!(off > 0.0 && off >= high - low && off > least_spike * share_of)) return {};
  if (!(off > steps_of_a_spike * x.step_near(first, last))) return {};
  return {first, last, above > 0.0 ? off : -off};
}

/// The test: what is still on its curve, and what was found.
class Sorting {
 public:
  explicit Sorting(const bekker_wong::PlateCurve& test) : z_(test.sinkage), p_(test.pressure) {
    for (std::size_t i = 0; i < p_.size(); ++i) live_.push_back(i);
  }

  LoadingCurve sorted() {
    take_spikes(z_, AsideWhy::sinkage_spike, [&](const SpikeBlock& b) { return b.off > 0.0 || !pressure_falls(b); });
    take_spikes(p_, AsideWhy::pressure_spike, [&](const SpikeBlock& b) { return b.off > 0.0 || goes_deeper(b); });
    take_unloading();
    take_stuck();
    take_off_the_power_law();
    std::ranges::sort(found_.aside, {}, [](const AsideReadings& aside) { return aside.readings.front(); });
    found_.readings = live_;
    return std::move(found_);
  }

 private:
  bool pressure_falls(const SpikeBlock& b) const {
    const LiveSeries p{p_, live_};
    const double beside = std::min(p[b.first - 1], p[b.last + 1]);
    for (std::size_t i = b.first; i <= b.last; ++i)
      if (p[i] < (1 - least_spike) * beside) return true;
    return false;
  }

  bool goes_deeper(const SpikeBlock& b) const {
    const LiveSeries z{z_, live_};
    for (std::size_t i = b.first; i <= b.last; ++i)
      if (!(z[i] > z[b.first - 1] && z[i] <= z[b.last + 1])) return false;
    return true;
  }

  /// Sets readings first .. last of those live aside; they are taken out at the end of a pass.
  AsideReadings& set_aside(AsideWhy why, std::size_t first, std::size_t last) {
    AsideReadings& aside = found_.aside.emplace_back();
    aside.why = why, aside.pressure = p_[live_[first]], aside.sinkage = z_[live_[first]];
    for (std::size_t i = first; i <= last; ++i) aside.readings.push_back(live_[i]), gone_.push_back(i);
    return aside;
  }

  void take_out() {
    std::ranges::sort(gone_);
    std::vector<std::size_t> kept;
    std::size_t next = 0;
    for (std::size_t i = 0; i < live_.size(); ++i) {
      while (next < gone_.size() && gone_[next] < i) ++next;
      if (next == gone_.size() || gone_[next] != i) kept.push_back(live_[i]);
    }
    live_ = std::move(kept);
    gone_.clear();
  }

  /// Until none is left: a spike beside another may hide it.
  void take_spikes(const std::vector<double>& of, AsideWhy why, const auto& may, double share_of = 0.0) {
    constexpr int rounds = 20;
    for (int round = 0; round < rounds; ++round) {
      const LiveSeries x{of, live_};
      for (std::size_t first = 1; first + 1 < x.size(); ++first) {
        SpikeBlock most;
        for (std::size_t last = first; last < first + longest_spike && last + 1 < x.size(); ++last) {
          const double share = share_of > 0.0 ? share_of : std::max(x[first - 1], x[last + 1]);
          const SpikeBlock block = spike_at(x, first, last, share);
          if (std::abs(block.off) > std::abs(most.off) && may(block)) most = block;
        }
        if (most.off == 0.0) continue;
        set_aside(why, most.first, most.last);
        first = most.last + 1;  // what stands behind a spike is held against others in the next round
      }
      if (gone_.empty()) return;
      take_out();
    }
  }

  /// Standard deviation of a series' noise by the median second difference: of neighbours that lie on a line, 0.
  double noise(const std::vector<double>& of) const {
    const LiveSeries x{of, live_};
    std::vector<double> off;
    for (std::size_t i = 1; i + 1 < x.size(); ++i) off.push_back(std::abs(x[i] - (x[i - 1] + x[i + 1]) / 2));
    return 1.4826 * std::sqrt(2.0 / 3) * middle_value(off);
  }

  /// Readings that lie no deeper than the plate has been and at less pressure than it bore there. Where the sinkage
  /// goes back and the pressure does not, the deeper reading is a spike: no soil lifts a plate that is pressed on.
  void take_unloading() {
    const double noise_z = noise(z_), noise_p = noise(p_);
    std::vector<std::size_t> curve;  // places in live_
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    std::size_t branch = none;
    Reached reached;
    const auto ends = [&](std::size_t i) {
      if (branch != none)
        take_branch(branch, i - 1, curve.back(), 5 * std::min(noise_z, 0.0005 * reached.deepest), 10 * noise_p);
      branch = none;
    };
    for (std::size_t i = 0; i < live_.size(); ++i) {
      const double z = z_[live_[i]], p = p_[live_[i]], near = 5 * noise_z + 0.002 * reached.deepest,
                   far = 10 * noise_z + least_spike * reached.deepest, most = reached.most(),
                   least = (1 - least_spike) * most - 6 * noise_p;
      if (!curve.empty() && z < reached.deepest - far && p >= least && branch == none) {
        std::size_t deeper = 0;
        while (deeper < curve.size() && z_[live_[curve[curve.size() - 1 - deeper]]] > z + far) ++deeper;
        if (deeper > longest_spike) {
          set_aside(AsideWhy::sinkage_spike, i, i);
          continue;
        }
        for (; deeper > 0; --deeper, curve.pop_back()) set_aside(AsideWhy::sinkage_spike, curve.back(), curve.back());
        reached = {};
        for (std::size_t k = curve.size() - std::min<std::size_t>(curve.size(), 20); k < curve.size(); ++k)
          reached.add(z_[live_[curve[k]]], p_[live_[curve[k]]], near);
      } else if (!curve.empty() && z <= reached.deepest + near && p < least) {
        branch = std::min(branch, i);
        continue;
      }
      ends(i);
      curve.push_back(i);
      reached.add(z, p, near);
    }
    ends(live_.size());
    take_out();
  }

  /// How deep the plate has been, and the most that it bore about there.
  struct Reached {
    double deepest = 0.0, borne = 0.0, borne_before = 0.0, since = 0.0;
    double most() const { return std::max(borne, borne_before); }
    void add(double z, double p, double near) {
      if (z > since + near) borne_before = borne, borne = p, since = z;
      borne = std::max(borne, p), deepest = std::max(deepest, z);
    }
  };

  /// One or two readings of less pressure are a spike, or noise; more are a branch, with k_u where it moves and is a
  /// line.
  void take_branch(std::size_t first, std::size_t last, std::size_t top, double moves, double noise) {
    constexpr std::size_t fewest = 3;
    constexpr double least_correlation = 0.8, least_fall = 0.1;
    const bool spike = last - first + 1 < fewest && last + 1 < live_.size();
    const double borne = p_[live_[top]];
    if (spike && p_[live_[first]] > 0.9 * borne - noise) return;
    AsideReadings& aside = set_aside(spike ? AsideWhy::pressure_spike : AsideWhy::unloading, first, last);
    if (spike) return;
    aside.pressure = borne, aside.sinkage = z_[live_[top]];
    std::vector<std::size_t> line = without_the_hold(aside.readings, live_[top], moves);
    double mean_z = 0.0, mean_p = 0.0, zz = 0.0, zp = 0.0, pp = 0.0, low = z_[line[0]], high = low, fall = 0.0;
    for (const std::size_t i : line) {
      mean_z += z_[i] / static_cast<double>(line.size()), mean_p += p_[i] / static_cast<double>(line.size());
      low = std::min(low, z_[i]), high = std::max(high, z_[i]);
    }
    for (const std::size_t i : aside.readings) fall = std::max(fall, borne - p_[i]);
    for (const std::size_t i : line) {
      const double dz = z_[i] - mean_z, dp = p_[i] - mean_p;
      zz += dz * dz, zp += dz * dp, pp += dp * dp;
    }
    if (fall > least_fall * borne && high - low > moves && zp > least_correlation * std::sqrt(zz * pp))
      aside.unloading_stiffness = zp / zz;
  }

  /// The readings of a branch, and the one before where none of them is deeper, but for those of a hold: a plate that
  /// was lifted and stands there while the pressure relaxes says nothing of the slope, and may have a hundred times the
  /// readings.
  std::vector<std::size_t> without_the_hold(const std::vector<std::size_t>& branch, std::size_t top,
                                            double moves) const {
    std::vector<std::size_t> line;
    double low = z_[branch.front()], high = low;
    for (const std::size_t i : branch) low = std::min(low, z_[i]), high = std::max(high, z_[i]);
    if (z_[top] >= high) line.push_back(top), high = z_[top];
    bool holds = false;  // the first reading of a hold ends the fall and stays
    for (const std::size_t i : branch) {
      const bool held = z_[i] < low + std::max(0.1 * (high - low), 0.5 * moves);
      if (!(held && holds)) line.push_back(i);
      holds = held;
    }
    return line;
  }

  /// Three readings or more behind one, of much more pressure at its sinkage: the sensor sticks or is at its end, or
  /// the plate stands on hard ground.
  void take_stuck() {
    constexpr double most_exponent = 20.0, least_rise = 1.5, least_share = 0.1;
    constexpr std::size_t fewest = 3;
    double most = 0.0;
    for (const std::size_t i : live_) most = std::max(most, p_[i]);
    const auto stands = [&](std::size_t i, std::size_t j) {
      return std::abs(std::log(z_[live_[j]] / z_[live_[i]])) * most_exponent < std::log(p_[live_[j]] / p_[live_[i]]);
    };
    double borne = 0.0;  // after a hold a plate bears again, without going deeper, what it bore before
    for (std::size_t i = 0; i + fewest < live_.size(); ++i) {
      borne = std::max(borne, p_[live_[i]]);
      if (p_[live_[i]] < 0.9 * borne) continue;
      std::size_t last = i;
      while (last + 1 < live_.size() && stands(i, last + 1)) ++last;
      const double from = p_[live_[i]], to = p_[live_[last]];
      if (last - i < fewest || to < least_rise * from || to < least_share * most) continue;
      AsideReadings& aside = set_aside(AsideWhy::stuck, i + 1, last);
      aside.pressure = from, aside.sinkage = z_[live_[i]];
      i = last;
    }
    take_out();
  }

  /// What is left of ln p once n ln z is off it changes slowly; a reading that jumps off and comes back is a spike that
  /// pressure and sinkage alone do not show, and so are one or two at an end that jump off by themselves.
  void take_off_the_power_law() {
    if (live_.size() < 6) return;
    const double n = typical_exponent();
    std::vector<double> left(p_.size());
    for (const std::size_t i : live_) left[i] = std::log(p_[i]) - n * std::log(z_[i]);
    constexpr double least = 0.05 / least_spike;  // [-]: 5 % of the pressure
    take_spikes(
        left, AsideWhy::pressure_spike, [](const SpikeBlock&) { return true; }, least);
    take_end(left, n, true);
    take_end(left, n, false);
  }

  /// Median of ln(p_j/p_i)/ln(z_j/z_i) over pairs half of the readings apart.
  double typical_exponent() const {
    std::vector<double> slopes;
    const std::size_t half = live_.size() / 2;
    for (std::size_t i = 0; i + half < live_.size(); ++i) {
      const double dz = std::log(z_[live_[i + half]] / z_[live_[i]]);
      if (dz > 0.0) slopes.push_back(std::log(p_[live_[i + half]] / p_[live_[i]]) / dz);
    }
    return middle_value(slopes);
  }

  /// More pressure than the curve beside promises, by half and more; or a plate so much deeper as none breaks through
  /// at once (on GRC-1 one went from 8 to 46 mm).
  void take_end(const std::vector<double>& left, double n, bool first) {
    constexpr double least_share = 0.1, firmer = 1.5, deeper = 8.0;
    const LiveSeries x{left, live_};
    double most = 0.0;
    for (const std::size_t i : live_) most = std::max(most, p_[i]);
    for (std::size_t length = 1; length <= 2 && length + 5 < x.size(); ++length) {
      const std::size_t from = first ? 0 : x.size() - length, to = from + length - 1,
                        beside = first ? to + 1 : from - 1;
      double above = std::numeric_limits<double>::infinity(), below = above, pressure = 0.0;
      for (std::size_t i = from; i <= to; ++i) {
        above = std::min(above, x[i] - x[beside]), below = std::min(below, x[beside] - x[i]);
        const double expected = std::exp(x[beside] + n * std::log(z_[live_[i]]));
        pressure = std::max({pressure, p_[live_[i]], std::min(expected, most)});
      }
      const double step = steps_of_a_spike * (first ? x.step_near(0, to) : x.step_near(from, x.size() - 1));
      if (pressure < least_share * most) continue;
      if (!(above > std::max(step, std::log(firmer)) || below > std::max(step, n * std::log(deeper)))) continue;
      set_aside(AsideWhy::end_spike, from, to);
      break;
    }
    take_out();
  }

  const std::vector<double>&z_, &p_;
  std::vector<std::size_t> live_, gone_;
  LoadingCurve found_;
};

}  // namespace

const char* word(AsideWhy why) {
  constexpr std::array<const char*, 5> words = {"sinkage_spike", "pressure_spike", "end_spike", "unloading", "stuck"};
  return words[static_cast<std::size_t>(why)];
}

LoadingCurve loading_curve(const bekker_wong::PlateCurve& test) { return Sorting(test).sorted(); }

}  // namespace soilbin::compare
