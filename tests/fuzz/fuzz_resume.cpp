// Resuming from a checkpoint whose arrays were changed: it is refused, or the run goes on and every number of
// its result is finite.
//
// Bytes, four for every change: which array, what happens to it (0 a number, 1 a row more, 2 a row less, 3 a
// column more, 4 it goes, 5 the iteration), which number, the value.
#include <algorithm>
#include <array>
#include <iterator>

#include "fuzz/contract.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/simulation/simulate.hpp"

namespace {

using namespace wilt;

Config short_run() {
  Config config = default_config(species("willow"));
  config.model = "paper";
  config.iterations = 4;
  config.frames = 3;
  return config;
}

struct Subject {
  Leaf leaf = make_leaf("willow", 200, 1);
  Config config = short_run();
  Venation venation = find_venation(leaf, species("willow").secondary);
  Checkpoint checkpoint = half_way();

  Checkpoint half_way() const {
    Simulation simulation(leaf, venation, config);
    for (int i = 0; i < 2; ++i) simulation.step();
    return simulation.checkpoint();
  }
};

double value_of(int byte) {
  static constexpr std::array<double, 8> kSpecial{0.0, -1.0, 0.5, 1e9, -1e300, 1e-300, 2147483648.0, 1e308};
  return byte < 8 ? kSpecial[static_cast<std::size_t>(byte)] : byte - 128;
}

void change(Checkpoint& checkpoint, fuzz::Bytes& bytes) {
  const int which = bytes.byte(), what = bytes.byte() % 6, where = bytes.byte();
  const double value = value_of(bytes.byte());
  if (checkpoint.arrays.empty()) return;
  const auto entry = std::next(checkpoint.arrays.begin(), which % static_cast<int>(checkpoint.arrays.size()));
  Eigen::MatrixXd& array = entry->second;
  const Eigen::Index rows = array.rows(), columns = array.cols();
  if (what == 0 && array.size() > 0) array.data()[where % array.size()] = value;
  if (what == 1) array.conservativeResizeLike(Eigen::MatrixXd::Constant(rows + 1, columns, value));
  if (what == 2 && rows > 0) array.conservativeResize(rows - 1, columns);
  if (what == 3) array.conservativeResizeLike(Eigen::MatrixXd::Constant(rows, columns + 1, value));
  if (what == 4) checkpoint.arrays.erase(entry);
  if (what == 5) checkpoint.iteration = where - 2;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Subject subject;
  Checkpoint checkpoint = subject.checkpoint;
  fuzz::Bytes bytes(data, std::min<std::size_t>(size, 64));
  while (bytes.left() > 0) change(checkpoint, bytes);
  Simulation simulation(subject.leaf, subject.venation, subject.config);
  const auto restored = fuzz::unless_refused([&] {
    simulation.restore(checkpoint);
    return true;
  });
  if (!restored) return 0;
  fuzz::require(simulation.iteration() >= 0 && simulation.iteration() <= simulation.last_iteration(),
                "the iteration is one of the run's");
  while (!simulation.ended()) simulation.step();
  const SimulationResult result = std::move(simulation).finish();
  for (const Frame& frame : result.frames)
    fuzz::require(frame.positions.allFinite() && frame.water_fraction.allFinite() &&
                      frame.dryness.allFinite() && frame.stalk.allFinite(),
                  "frames are finite");
  return 0;
}
