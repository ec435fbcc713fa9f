// Wilts a small leaf through the installed library, and checks that it moved.
#include <iostream>
#include <wilt/leaf/species.hpp>
#include <wilt/simulation/simulate.hpp>
#include <wilt/venation/venation.hpp>

int main() {
  const wilt::Species& ivy = wilt::species("ivy");
  const wilt::Leaf leaf = wilt::make_leaf(ivy.name, 400, 1);
  wilt::Config config = wilt::default_config(ivy);
  config.iterations = 10;
  const wilt::Venation venation = wilt::find_venation(leaf, ivy.secondary, wilt::venation_options(config));
  const wilt::SimulationResult result = wilt::simulate(leaf, venation, config);
  std::cout << "tips " << venation.tips.size() << ", frames " << result.frames.size() << ", curl "
            << result.metrics.back().curl << "\n";
  return venation.tips.size() == 5 && result.completed && result.metrics.back().curl > 0.0 ? 0 : 1;
}
