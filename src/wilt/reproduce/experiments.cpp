#include "wilt/reproduce/experiments.hpp"

#include <fmt/format.h>

#include <utility>

#include "wilt/simulation/simulate.hpp"

namespace wilt {

Experiments::Experiments(int vertices, std::uint64_t seed, const Monitor& monitor)
    : vertices_(vertices), seed_(seed), quiet_{{}, monitor.cancelled, monitor.note} {}

const Subject& Experiments::leaf(const std::string& name) {
  auto& subject = leaves_[name];
  if (subject) return *subject;
  quiet_.throw_if_cancelled();
  auto made = std::make_unique<Subject>();
  made->leaf = make_leaf(name, vertices_, seed_, quiet_);
  VenationOptions options = venation_options(Config());
  options.full_embedding_up_to = vertices_;  // all pairs are embedded, as in the paper
  made->venation = find_venation(made->leaf, species(name).secondary, options, {{}, quiet_.cancelled, {}});
  subject = std::move(made);
  return *subject;
}

Config Experiments::config(const std::string& name, const std::string& model,
                           const Overrides& overrides) const {
  Config config = default_config(species(name));
  config.vertices = vertices_;
  config.seed = static_cast<std::int64_t>(seed_);
  config.iterations = kIterations;
  config.frames = kFrames;
  set(config, "model", model);
  for (const auto& [key, value] : overrides) set(config, key, value);
  return config;
}

const Experiment& Experiments::run(const std::string& name, const std::string& model,
                                   const Overrides& overrides) {
  const Config resolved = config(name, model, overrides);
  auto& experiment = runs_[to_json(resolved)];
  if (!experiment) experiment = compute(name, resolved);
  if (!experiment->result.completed) broken_.insert(model);
  return *experiment;
}

std::unique_ptr<Experiment> Experiments::compute(const std::string& name, const Config& resolved) {
  const Subject& subject = leaf(name);
  SimulationResult result =
      simulate(subject.leaf, subject.venation, resolved, {{}, quiet_.cancelled, quiet_.note});
  quiet_.throw_if_cancelled();
  if (!result.completed)
    quiet_.say(fmt::format("{}, {}: stopped at {}", name, resolved.model, result.stop_reason));
  return std::make_unique<Experiment>(Experiment{subject, resolved, std::move(result)});
}

std::set<std::string> Experiments::take_broken() {
  return std::exchange(broken_, {});
}

std::string setting_text(double value) {
  return fmt::format("{}", value);
}

}  // namespace wilt
