// What every figure is made with.
#pragma once

#include <array>
#include <string>

#include "wilt/core/monitor.hpp"
#include "wilt/reproduce/experiments.hpp"
#include "wilt/reproduce/figure.hpp"
#include "wilt/reproduce/pictures.hpp"

namespace wilt {

/// The two models that every figure is shown under, in this order.
inline constexpr std::array<const char*, 2> kModels = {"paper", "cell"};

/// Experiments, pictures and plots, and the folder they go to; counts the work for the progress bar.
class Workshop {
 public:
  Workshop(const std::string& folder, int vertices, const PictureSettings& pictures, const Monitor& monitor)
      : monitor_(monitor),
        folder_(folder),
        experiments_(vertices, pictures.seed, monitor_),
        pictures_(pictures, monitor_) {}

  Experiments& experiments() { return experiments_; }
  const Pictures& pictures() const { return pictures_; }

  /// A figure starts: its steps are those of `done`.
  void start(const std::string& stage, int steps);
  void done(int steps = 1);

  /// Writes NAME.png and gives it as a block's part. Throws Error{output}.
  Picture save(const std::string& name, const Image& image, const std::string& alt,
               const std::string& caption = "") const;

  /// Writes the plot's files and gives them as a block. Throws Error{output}.
  PlotBlock draw(const Plot& plot, const std::string& caption, const std::string& alt) const;

 private:
  Monitor monitor_;
  std::string folder_;
  Experiments experiments_;
  Pictures pictures_;
  std::string stage_;
  int steps_ = 1, done_ = 0;
};

}  // namespace wilt
