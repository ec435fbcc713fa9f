#include "run_object.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "wilt/core/error.hpp"

namespace wilt::python {
namespace {

using Lock = std::lock_guard<FairMutex>;

std::unique_ptr<Simulation> at_rest(const Subject& subject, const Config& config) {
  return std::make_unique<Simulation>(subject.leaf->leaf, subject.veins->venation, config);
}

}  // namespace

void FairMutex::lock() {
  std::unique_lock<std::mutex> held(mutex_);
  const std::uint64_t mine = last_++;
  served_.wait(held, [&] { return serving_ == mine; });
}

void FairMutex::unlock() {
  const std::lock_guard<std::mutex> held(mutex_);
  ++serving_;
  served_.notify_all();
}

RunObject::RunObject(std::shared_ptr<const Subject> subject)
    : subject_(std::move(subject)), simulation_(at_rest(*subject_, subject_->config)) {}

int RunObject::iteration() const {
  const Lock lock(mutex_);
  return simulation_->iteration();
}

int RunObject::last_iteration() const {
  return static_cast<int>(subject_->config.iterations);
}

bool RunObject::ended() const {
  const Lock lock(mutex_);
  return simulation_->ended();
}

Config RunObject::config() const {
  const Lock lock(mutex_);
  return simulation_->config();
}

void RunObject::change(const std::vector<Assignment>& settings) {
  const Lock lock(mutex_);
  Config tried = simulation_->config();  // all of them or none
  for (const Assignment& one : settings) add_change(tried, simulation_->iteration(), one.key, one.value);
  for (const Assignment& one : settings) simulation_->change(one.key, one.value);
  result_.reset();
}

void RunObject::step_once() {
  const auto start = std::chrono::steady_clock::now();
  simulation_->step();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  state_.reset();
  result_.reset();
}

void RunObject::step() {
  const Lock lock(mutex_);
  step_once();
}

void RunObject::run(const Monitor& monitor) {
  while (!ended()) {
    monitor.throw_if_cancelled();
    step();
  }
}

std::shared_ptr<StateObject> RunObject::state() {
  const Lock lock(mutex_);
  if (state_) return state_;
  const MotionState& motion = simulation_->motion();
  const DeformationModel& model = simulation_->model();
  auto state = std::make_shared<StateObject>();
  state->subject = subject_;
  state->frame = std::make_shared<const Frame>(simulation_->frame());
  state->metrics = simulation_->metrics();
  state->working_positions = motion.positions;
  state->velocities = motion.velocities;
  state->water = model.water();
  state->dry_mass = model.dry_mass();
  state->mass = state->water + state->dry_mass;
  state->pressure = -model.pressure_drop();
  state->forces = model.forces(motion.positions, motion.velocities);
  return state_ = std::move(state);
}

std::shared_ptr<ResultObject> RunObject::result() {
  const Lock lock(mutex_);
  if (result_) return result_;
  auto withered = std::make_shared<WitheredLeaf>();
  withered->leaf = subject_->leaf->leaf;
  withered->venation = subject_->veins->venation;
  withered->config = simulation_->config();
  withered->result = std::as_const(*simulation_).finish();
  const Venation::Timings& veins = withered->venation.timings;
  withered->timings = {subject_->leaf->seconds, veins.geodesics, veins.embedding,
                       veins.venation,          seconds_,        0.0};
  if (!simulation_->ended()) {
    withered->result.completed = false;
    withered->result.stop_reason =
        fmt::format("interrupted after iteration {} of {}", simulation_->iteration(), last_iteration());
  }
  return result_ = std::make_shared<ResultObject>(ResultObject{subject_, std::move(withered)});
}

std::string RunObject::checkpoint() const {
  const Lock lock(mutex_);
  if (!simulation_->result().completed)
    throw Error(ErrorCode::configuration, fmt::format("a run that has stopped cannot be gone on with ({})",
                                                      simulation_->result().stop_reason));
  return checkpoint_bytes(simulation_->checkpoint());
}

void RunObject::restore(const std::string& bytes) {
  const Checkpoint checkpoint = parse_checkpoint(bytes, "checkpoint");
  const bool unchanged = checkpoint.config == to_json(subject_->config);
  auto restored = at_rest(*subject_, unchanged ? subject_->config : config());
  restored->restore(checkpoint);
  const Lock lock(mutex_);
  simulation_ = std::move(restored);
  state_.reset();
  result_.reset();
}

}  // namespace wilt::python
