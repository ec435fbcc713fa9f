// A simulation that Python's threads may share.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "objects.hpp"
#include "wilt/core/monitor.hpp"
#include "wilt/simulation/simulate.hpp"

namespace wilt::python {

/// A mutex that whoever came first gets first: with std::mutex, who steps in a loop keeps all others out.
class FairMutex {
 public:
  void lock();
  void unlock();

 private:
  std::mutex mutex_;
  std::condition_variable served_;
  std::uint64_t last_ = 0, serving_ = 0;
};

/// A leaf that withers step by step. Threads may share it: each waits for the step that another one is at.
class RunObject {  // none of whose functions touches Python
 public:
  explicit RunObject(std::shared_ptr<const Subject> subject);

  const Subject& subject() const { return *subject_; }
  int iteration() const;       ///< the last one done; 0: at rest
  int last_iteration() const;  ///< how many there are to be
  bool ended() const;          ///< whether all iterations are done, or the run has stopped

  /// The run's, with what was changed until now.
  Config config() const;

  /// Has settings change now: simulation.change(water__humidity=0.2). The next steps have the new values, and
  /// `config` says so. Those that may are during_run in wilt.settings(). Raises ValueError for others, and
  /// for values out of range; nothing has changed then.
  void change(const std::vector<Assignment>& settings);

  /// One iteration. When it cannot be done the run stops: `result` says why, what was computed is kept.
  /// Nothing happens once it has ended.
  void step();

  /// All iterations that are left. Throws Error{interrupted} after the one that is being done when the
  /// monitor says so.
  void run(const Monitor& monitor);

  /// All there is to know now. It does not change when the simulation goes on; asked for twice at one
  /// iteration it is the same object, so that its arrays are copied once.
  std::shared_ptr<StateObject> state();

  /// What was recorded until now, with a frame of the last iteration. It does not change when the simulation
  /// goes on.
  std::shared_ptr<ResultObject> result();

  /// All that it takes to go on from here, as bytes: the content of a file of `wilt simulate --checkpoint`.
  /// Raises ValueError when the run has stopped.
  std::string checkpoint() const;

  /// Goes on from a checkpoint of a simulation like this one: results are as if it had never been left.
  /// Raises ValueError when it is of another leaf, other veins, another configuration or version; the
  /// simulation is then as it was. What was changed since stays only if the checkpoint knows of it.
  void restore(const std::string& bytes);

 private:
  void step_once();

  std::shared_ptr<const Subject> subject_;
  mutable FairMutex mutex_;
  std::unique_ptr<Simulation> simulation_;
  double seconds_ = 0.0;
  std::shared_ptr<StateObject> state_;    // of this iteration, once it was asked for
  std::shared_ptr<ResultObject> result_;  // the same
};

}  // namespace wilt::python
