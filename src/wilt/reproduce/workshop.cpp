#include "wilt/reproduce/workshop.hpp"

#include <algorithm>

#include "wilt/output/picture_file.hpp"

namespace wilt {

void Workshop::start(const std::string& stage, int steps) {
  stage_ = stage;
  steps_ = steps;
  done_ = 0;
  monitor_.report(stage_, 0.0);
}

void Workshop::done(int steps) {
  monitor_.throw_if_cancelled();
  done_ += steps;
  monitor_.report(stage_, std::min(1.0, static_cast<double>(done_) / steps_));
}

Picture Workshop::save(const std::string& name, const Image& image, const std::string& alt,
                       const std::string& caption) const {
  write_image(folder_ + "/" + name + ".png", image);
  return {name + ".png", alt, caption};
}

PlotBlock Workshop::draw(const Plot& plot, const std::string& caption, const std::string& alt) const {
  return {caption, alt, write_plot(plot, folder_)};
}

}  // namespace wilt
