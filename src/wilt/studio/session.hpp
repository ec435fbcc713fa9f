// One leaf that withers while somebody looks and turns knobs: what the studio's page talks to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wilt/leaf/leaf.hpp"
#include "wilt/output/leaf_paint.hpp"
#include "wilt/simulation/simulate.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// Edits of the veins that were found. Places on the margin as MarginProfile::s has them, metres.
struct VeinEdits {
  std::vector<double> added;    ///< tips to be added
  std::vector<double> removed;  ///< tips that were found and are to go
};

/// The veins with tips added and removed, by with_drawn_veins(). A removed place means the nearest tip.
/// Throws Error{input} when no tip is left or a place is not on the margin.
Venation edited_venation(const Leaf& leaf, const Venation& found, const VeinEdits& edits,
                         const VenationOptions& options);

/// A leaf, its veins and a run that can be changed, left and gone back in.
///
/// What it shows and writes is what `wilt simulate` with config() does. A method that throws changes nothing.
class StudioSession {
 public:
  /// Finds the veins and starts a run. The configuration is resolve_config() of `preset`, a configuration
  /// file's text and what is `given` with the leaf (its seed, its vertices). Throws as that and
  /// find_venation() do.
  StudioSession(Leaf leaf, const VeinEdits& edits, std::string preset, std::vector<Assignment> given,
                const std::string& toml);
  ~StudioSession();

  const Leaf& leaf() const { return leaf_; }
  const Venation& venation() const { return venation_; }
  const Simulation& simulation() const { return *simulation_; }
  const Config& config() const { return simulation_->config(); }
  /// The settings of the next step: config() with all changes made that have come.
  Config settings_now() const { return config_after(config(), simulation_->iteration()); }
  /// The leaf's colours, over its texture once that has been painted.
  const LeafPaint& paint() const { return paint_; }
  double first_water() const { return first_water_; }  ///< of the whole leaf at rest, working units

  /// Starts again from the leaf at rest. The veins stay those that were found.
  void start(const std::string& toml);
  void step() { simulation_->step(); }
  /// As Simulation::change does.
  void change(const std::string& key, const std::string& value) { simulation_->change(key, value); }
  /// The state after `iteration`, 0 to the last one done; later changes are forgotten.
  void rewind(int iteration);
  /// Draws the blade's texture, `size` x `size` texels; 0: none. The run's own files keep `texture.size`.
  void paint_texture(int size);

  /// The bytes of a file of the run up to now: "glb", "forces.csv", "toml", "report.json", "veins.json".
  std::string file(const std::string& kind) const;

 private:
  Config resolved(const std::string& toml) const;
  void begin(const Config& config);

  Leaf leaf_;
  std::string preset_;
  std::vector<Assignment> given_;
  Venation venation_;
  std::unique_ptr<Simulation> simulation_;
  double first_water_;
  LeafPaint paint_;
};

}  // namespace wilt
