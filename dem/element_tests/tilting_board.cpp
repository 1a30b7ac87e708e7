#include "dem/element_tests/tilting_board.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/bed/grain_shape.hpp"

namespace soilbin::dem {
namespace {

void check(const TiltingBoardSettings& s) {
  const Requirements require("tilting board");
  require(s.across >= 1 && s.across <= 1000, "1 to 1000 grains across");
  require(s.layers >= 1 && s.layers <= 100, "1 to 100 layers");
  require(s.rate >= 1e-6 && s.steepest > 0 && s.steepest < std::numbers::pi / 2,
          "tilt at 1e-6 rad/s or more, below 90 deg");
  require(s.onset > 0 && s.gone > s.onset, "onset above 0, gone above onset");
}

/// Sand on the board, from laying it down to its slide.
class Board {
 public:
  Board(const GranularSoil& soil, const TiltingBoardSettings& settings, const WorkOptions& how)
      : settings_(settings),
        d_(mean_diameter(soil)),
        gravity_(gravity_on(soil)),
        work_(how),
        simulation_(setup_for(soil, how)) {
    lay(soil);
  }

  TiltingBoardResult run();

 private:
  Setup setup_for(const GranularSoil& soil, const WorkOptions& how) const;
  void lay(const GranularSoil& soil);
  void settle();
  TiltSample sample() const;
  void find_angles(TiltingBoardResult& result) const;

  const TiltingBoardSettings& settings_;
  double d_, gravity_, angle_ = 0;
  SteppedWork work_;
  Simulation simulation_;
  std::vector<Vec3> start_;
  std::vector<double> turned_;
};

Setup Board::setup_for(const GranularSoil& soil, const WorkOptions& how) const {
  const double room = (settings_.across + settings_.layers + 100) * d_ * 2;
  Setup setup = loose_setup(soil, settings_.dt, room, how);
  const int board = setup.materials.add({"board", 1100, 1e9, 0.3});  // as the tire of a run
  setup.materials.set(grain_material, board, interaction_of(soil.grain_tire));
  setup.laws = with_cohesion_of(soil.grain_tire, with_cohesion_of(soil.grain_grain, settings_.laws));
  return setup;
}

/// Layers of grains that do not touch, the lowest just above the board; spheres fall by less than a tenth of a grain
/// each, others by up to half of one.
void Board::lay(const GranularSoil& soil) {
  Body board;
  board.name = "board";
  board.surfaces.push_back({Plane{}, 1});
  simulation_.add_body(board);
  GrainMaker maker(soil, settings_.packing);
  const RadiusRange balls = maker.balls();
  const double place = 1.06 * 2 * balls.largest;
  const int layers = static_cast<int>(std::lround(settings_.layers)), across = settings_.across;
  for (int layer = 0; layer < layers; ++layer) {
    const Region region{{0, 0, layer * place}, {across * place, across * place, (layer + 1) * place}};
    insert_loosely([&](const Vec3& centre, double ball) { maker.put(simulation_, centre, ball); }, region, balls,
                   across * across, settings_.packing + static_cast<std::uint64_t>(layer));
  }
}

/// Lays the grains down on the level board, then waits until they lie still.
void Board::settle() {
  work_.begin("settling");
  simulation_.set_gravity({0, 0, -gravity_});
  const double fall = 4 * std::sqrt(2 * d_ * settings_.layers / gravity_) + 0.2;
  const auto steps = static_cast<std::int64_t>(fall / simulation_.setup().numerics.dt);
  for (std::int64_t k = 0; k < steps; ++k) work_.step(simulation_);
}

TiltSample Board::sample() const {
  TiltSample out{.angle = angle_};
  const Grains& grains = simulation_.state().grains;
  const auto n = static_cast<double>(grains.count());
  for (std::size_t k = 0; k < grains.count(); ++k) {
    out.slide += (grains.motion[k].position.x - start_[grains.id[k]].x) / n;
    out.turn += turned_[grains.id[k]] / n;
  }
  return out;
}

/// The onset is a mean slide beyond the creep up to half the angle at which the sand was gone; between samples by
/// straight lines.
void Board::find_angles(TiltingBoardResult& result) const {
  const std::vector<TiltSample>& curve = result.curve;
  const auto angle_at = [&](double slide) {
    for (std::size_t k = 1; k < curve.size(); ++k)
      if (curve[k].slide >= slide) {
        const TiltSample &a = curve[k - 1], &b = curve[k];
        const double share = (slide - a.slide) / (b.slide - a.slide);
        return a.angle + std::clamp(share, 0.0, 1.0) * (b.angle - a.angle);
      }
    return curve.back().angle;
  };
  result.gone = angle_at(settings_.gone * d_);
  double crept = 0;
  for (const TiltSample& sample : curve)
    if (sample.angle <= result.gone / 2) crept = sample.slide;
  result.onset = angle_at(crept + settings_.onset * d_);
}

TiltingBoardResult Board::run() {
  TiltingBoardResult result;
  const double dt = simulation_.setup().numerics.dt;
  work_.expect(settings_.steepest / settings_.rate / dt);
  settle();
  const Grains& grains = simulation_.state().grains;
  result.grains = static_cast<int>(number_of_grains(simulation_.state()));
  result.mean_diameter = d_, result.packing = settings_.packing;
  start_.resize(grains.count()), turned_.assign(grains.count(), 0);
  for (std::size_t k = 0; k < grains.count(); ++k) start_[grains.id[k]] = grains.motion[k].position;

  work_.begin("tilting");
  constexpr double between = 0.002;  // samples, rad
  const auto steps = std::max<std::int64_t>(1, std::llround(between / (settings_.rate * dt)));
  result.curve.push_back(sample());
  while (angle_ < settings_.steepest && !result.slid) {
    for (std::int64_t k = 0; k < steps; ++k) {
      angle_ += settings_.rate * dt;
      simulation_.set_gravity(gravity_ * Vec3{std::sin(angle_), 0, -std::cos(angle_)});
      work_.step(simulation_);
    }
    for (std::size_t k = 0; k < grains.count(); ++k)
      turned_[grains.id[k]] += grains.spin[k].rate.y * dt * static_cast<double>(steps);
    result.curve.push_back(sample());
    result.slid = result.curve.back().slide > settings_.gone * d_;
  }
  if (result.slid)
    find_angles(result);
  else
    result.onset = result.gone = angle_;
  return result;
}

}  // namespace

TiltingBoardResult tilting_board(const GranularSoil& soil, const TiltingBoardSettings& settings,
                                 const WorkOptions& how) {
  check(settings);
  return Board(soil, settings, how).run();
}

}  // namespace soilbin::dem
