// Bullet's deformable bodies (single precision, as Debian builds them): backward Euler, one Newton step a
// time step, a matrix-free Krylov solve, mass-spring force. A cheaper and less accurate step than implicit
// midpoint to 1e-8.
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <benchmark/benchmark.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "bench/scenario.hpp"
#include "bench/stopwatch.hpp"

namespace wilt::bench {
namespace {

btScalar single(double value) {
  return static_cast<btScalar>(value);
}

// The workload in a world of its own, without collisions.
class BulletLeaf {
 public:
  explicit BulletLeaf(const SpringProblem& problem)
      : problem_(problem),
        dispatcher_(&configuration_),
        springs_(single(problem.stiffness), single(problem.damping), true, 0),
        gravity_(btVector3(0, 0, single(-problem.gravity))) {
    constraints_.setDeformableSolver(&solver_);
    world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&dispatcher_, &broadphase_, &constraints_,
                                                                  &configuration_, &solver_);
    world_->setImplicit(true);
    world_->setLineSearch(false);
    world_->setUseProjection(true);
    const btVector3 down(0, 0, single(-problem.gravity));
    world_->setGravity(down);
    world_->getWorldInfo().m_gravity = down;
    world_->getWorldInfo().air_density = 0;
    add_body();
    world_->addForce(body_.get(), &springs_);
    world_->addForce(body_.get(), &gravity_);
  }

  void set_rest_lengths(const Eigen::VectorXd& lengths) {
    for (int e = 0; e < problem_.edge_count(); ++e) {
      btSoftBody::Link& link = body_->m_links[e];
      link.m_rl = single(lengths[e]);
      link.m_c1 = link.m_rl * link.m_rl;
    }
  }

  void step() { world_->stepSimulation(single(problem_.dt), 1, single(problem_.dt)); }

  Points3 positions() const {
    Points3 x(problem_.vertex_count(), 3);
    for (int i = 0; i < x.rows(); ++i) {
      const btVector3& p = body_->m_nodes[i].m_x;
      x.row(i) << p.x(), p.y(), p.z();
    }
    return x;
  }

 private:
  void add_body() {
    std::vector<btVector3> points;
    std::vector<btScalar> masses;
    for (int i = 0; i < problem_.vertex_count(); ++i) {
      const auto p = problem_.positions.row(i);
      points.emplace_back(single(p[0]), single(p[1]), single(p[2]));
      masses.push_back(problem_.pinned[static_cast<std::size_t>(i)] ? 0 : single(problem_.masses[i]));
    }
    body_ = std::make_unique<btSoftBody>(&world_->getWorldInfo(), problem_.vertex_count(), points.data(),
                                         masses.data());
    body_->m_links.reserve(problem_.edge_count());
    for (int e = 0; e < problem_.edge_count(); ++e)
      body_->appendLink(problem_.edges(e, 0), problem_.edges(e, 1), nullptr, false);
    body_->m_cfg.collisions = 0;
    body_->m_cfg.kDP = 0;
    body_->m_sleepingThreshold = 0;
    body_->setActivationState(DISABLE_DEACTIVATION);
    world_->addSoftBody(body_.get());
  }

  const SpringProblem& problem_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btDeformableBodySolver solver_;
  btDeformableMultiBodyConstraintSolver constraints_;
  btDeformableMassSpringForce springs_;
  btDeformableGravityForce gravity_;
  std::unique_ptr<btSoftBody> body_;
  std::unique_ptr<btDeformableMultiBodyDynamicsWorld> world_;
};

void bullet_step(benchmark::State& state, int vertices, double stiffness) {
  const SpringProblem problem = spring_problem(vertices, stiffness);
  BulletLeaf leaf(problem);
  StepTimes times(state, problem);
  int step = 0;
  for (auto _ : state) {
    leaf.set_rest_lengths(problem.rest_lengths(step++));
    const Stopwatch watch;
    leaf.step();
    times.add(watch.seconds());
  }
  times.report(leaf.positions());
}
WILT_STEP_SCENARIOS(bullet_step);

}  // namespace
}  // namespace wilt::bench
