// Symbols: a age, a_0 that at rest; M the species' colour, q the photo's over it; R, G, B, Y linear light.
#include "wilt/simulation/photo_tissue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/smooth_step.hpp"
#include "wilt/core/srgb.hpp"

namespace wilt {
namespace {

// Scatter of photos of one and the same tissue, in natural logarithms: of red over green, of brightness, of
// blue over both. Age and redness cost what makes the fresher of two that fit alike win.
constexpr double kHueScatter = 0.2, kLightScatter = 0.8, kBlueScatter = 1.5;
constexpr double kAgeCost = 0.3, kRedCost = 0.5;
constexpr int kAges = 93, kReds = 5;  // that are tried

constexpr double kBrightestOf = 2.5;  // standard deviations above the mean
constexpr double kFaintest = 3.0;     // of 255: darker means are not told apart
constexpr double kHueFades = 0.85;    // share of the light's and camera's hue that goes with the pigments
constexpr double kLightKept = 0.4;    // power of its brightness that stays

// Steps of 255 by which texture x vertex colour may miss the photo; blue weighs a tenth of green to the eye.
constexpr std::array<double, 3> kSlack{1.5, 1.5, 5.5};

// Logarithms of what is compared: red over green, brightness, blue over their mean.
Vec3 features(const Vec3& colour) {
  const Vec3 c = colour.cwiseMax(1e-4);
  return {std::log(c.x() / c.y()), std::log(luminance(c)), std::log(c.z() / std::sqrt(c.x() * c.y()))};
}

struct Candidate {
  double age, redness;
  Vec3 features;

  double misfit(const Vec3& of) const {
    const Vec3 miss = (features - of).cwiseQuotient(Vec3(kHueScatter, kLightScatter, kBlueScatter));
    return miss.squaredNorm() + kAgeCost * age + kRedCost * redness * redness;
  }
};

// Ages of one redness after the other.
std::vector<Candidate> candidates(const TissueColours& colours) {
  std::vector<Candidate> all;
  for (int j = 0; j < kReds; ++j) {
    for (int i = 0; i < kAges; ++i) {
      const double age = kOldestTissue * i / (kAges - 1), red = j / (kReds - 1.0);
      all.push_back({age, red, features(colours({age, red, 0.0}))});
    }
  }
  return all;
}

// The best of all, its age put between the steps by a parabola.
Candidate nearest(const std::vector<Candidate>& all, const Vec3& of) {
  std::size_t best = 0;
  double least = all[0].misfit(of);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double misfit = all[i].misfit(of);
    if (misfit < least) best = i, least = misfit;
  }
  Candidate found = all[best];
  const std::size_t step = best % kAges;
  if (step == 0 || step + 1 == kAges) return found;
  const double before = all[best - 1].misfit(of), after = all[best + 1].misfit(of);
  const double bend = before - 2.0 * least + after;
  if (bend > 0.0) found.age += 0.5 * (before - after) / bend * kOldestTissue / (kAges - 1);
  return found;
}

// Mean and standard deviation of the encoded texels around each vertex, each weighed as in interpolation. A
// vertex without texels has the one that it lies on.
class AroundVertices {
 public:
  AroundVertices(const BladeTexels& texels, const Image& photo) : count_(texels.leaf().positions.rows()) {
    const Skin& skin = texels.leaf().skin;
    const UvRaster& raster = texels.raster();
    for (Eigen::Index s = 0; s < skin.uv.rows(); ++s) {
      const auto texel = [&](double uv) {
        return std::clamp(static_cast<int>(uv * raster.size), 0, raster.size - 1);
      };
      add(skin.vertex[static_cast<std::size_t>(s)], kLittle,
          photo.pixel(texel(skin.uv(s, 0)), texel(skin.uv(s, 1))));
    }
    for (int y = 0; y < raster.size; ++y) {
      for (int x = 0; x < raster.size; ++x) {
        const int face = raster.face[static_cast<std::size_t>(y) * raster.size + x];
        if (face < 0) continue;
        const Vec3 weights = uv_weights(skin, face, texel_centre(x, y, raster.size));
        for (int c = 0; c < 3; ++c)
          add(skin.vertex[static_cast<std::size_t>(skin.faces(face, c))], weights[c], photo.pixel(x, y));
      }
    }
  }

  Points3 mean() const { return linear(0.0, Vec3::Zero()); }
  /// Of what the texture must hold.
  Points3 brightest() const { return linear(kBrightestOf, Vec3(kSlack[0], kSlack[1], kSlack[2])); }

 private:
  // Linear colour, `deviations` above the mean and `less` below that, but never below the mean.
  Points3 linear(double deviations, const Vec3& less) const {
    Points3 result(count_, 3);
    for (Eigen::Index v = 0; v < count_; ++v) {
      const Sums& sums = sums_[static_cast<std::size_t>(v)];
      const Vec3 mean = sums.value / sums.weight;
      const Vec3 spread = (sums.square / sums.weight - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
      for (int c = 0; c < 3; ++c) {
        const double encoded = mean[c] + std::max(deviations * spread[c] - less[c], 0.0);
        result(v, c) = decode_srgb(std::clamp(encoded, kFaintest, 255.0) / 255.0);
      }
    }
    return result;
  }

  static constexpr double kLittle = 1e-3;
  struct Sums {
    double weight = 0.0;
    Vec3 value = Vec3::Zero(), square = Vec3::Zero();
  };

  void add(VertexId v, double weight, const std::uint8_t* rgb) {
    Sums& sums = sums_[static_cast<std::size_t>(int(v))];
    const Vec3 value(rgb[0], rgb[1], rgb[2]);
    sums.weight += weight;
    sums.value += weight * value;
    sums.square += weight * value.cwiseAbs2();
  }

  Eigen::Index count_;
  std::vector<Sums> sums_ = std::vector<Sums>(static_cast<std::size_t>(count_));
};

// Share of the photo's own hue that went with the green.
double gone(double age) {
  return smooth_step(0.08, 0.8, age);
}

// Linear light of bytes moved by a number of steps.
class Decoder {
 public:
  explicit Decoder(double moved) {
    for (std::size_t b = 0; b < table_.size(); ++b)
      table_[b] = decode_srgb(std::clamp(static_cast<double>(b) + moved, 0.0, 255.0) / 255.0);
  }
  double operator()(std::uint8_t byte) const { return table_[byte]; }

 private:
  std::array<double, 256> table_{};
};

class PhotoPainter {
 public:
  PhotoPainter(const BladeTexels& texels, const Image& photo, const PhotoTissue& tissue,
               const PhotoLevels& levels, const Eigen::VectorXd& faded)
      : texels_(texels), photo_(photo), tissue_(tissue), levels_(levels), faded_(faded) {}

  void paint(const BladeRow& row, Image& texture) const {
    const Channels mean = at_texels(tissue_.colour, row), first = at_texels(levels_.first, row),
                   level = at_texels(levels_.texture, row);
    std::vector<float> faded;
    texels_.interpolate(faded_, row, faded);
    for (int i = 0; i < row.count(); ++i) {
      const std::uint8_t* seen = photo_.pixel(row.columns[i], row.y);
      std::uint8_t* out = texture.pixel(row.columns[i], row.y);
      const Vec3 light(decode_(seen[0]), decode_(seen[1]), decode_(seen[2]));
      const double green = light.y() / mean[1][i];
      for (std::size_t c = 0; c < 3; ++c) {
        const double detail = light[c] / mean[c][i];
        const double wanted = level[c][i] * (detail + faded[i] * (green - detail));
        out[c] = encode_(std::clamp(wanted, low_[c](seen[c]) / first[c][i], high_[c](seen[c]) / first[c][i]));
      }
    }
  }

 private:
  using Channels = std::array<std::vector<float>, 3>;
  Channels at_texels(const Points3& values, const BladeRow& row) const {
    Channels channels;
    for (std::size_t c = 0; c < 3; ++c) texels_.interpolate(values.col(int(c)), row, channels[c]);
    return channels;
  }

  const BladeTexels& texels_;
  const Image& photo_;
  const PhotoTissue& tissue_;
  const PhotoLevels& levels_;
  const Eigen::VectorXd& faded_;
  Decoder decode_{0.0};
  std::array<Decoder, 3> low_{Decoder(-kSlack[0]), Decoder(-kSlack[1]), Decoder(-kSlack[2])};
  std::array<Decoder, 3> high_{Decoder(kSlack[0]), Decoder(kSlack[1]), Decoder(kSlack[2])};
  SrgbBytes encode_;
};

}  // namespace

PhotoTissue photo_tissue(const BladeTexels& texels, const Image& photo, const SenescencePattern& pattern,
                         const TissueColours& colours) {
  const AroundVertices around(texels, photo);
  PhotoTissue tissue{around.mean(), around.brightest(), {}, {}};
  const Eigen::Index count = tissue.colour.rows();
  tissue.age.resize(count), tissue.redness.resize(count);
  const std::vector<Candidate> all = candidates(colours);
  parallel_for(static_cast<int>(count), 64, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      const Candidate found = nearest(all, features(tissue.colour.row(v).transpose()));
      const double seen = red_made(found.age);
      tissue.age[v] = found.age;
      tissue.redness[v] = pattern.redness[v] + seen * (found.redness - pattern.redness[v]);
    }
  });
  return tissue;
}

Points3 aged_colours(const PhotoTissue& tissue, const SenescencePattern& pattern,
                     const TissueColours& colours, const Eigen::VectorXd& dryness) {
  Points3 result(dryness.size(), 3);
  parallel_for(static_cast<int>(dryness.size()), 1024, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      const double a = tissue_age(dryness[v], pattern.ahead[v]), a_0 = tissue.age[v], red = tissue.redness[v];
      const double age = a < 1.0 ? std::max(a_0, 1.0 - (1.0 - a) * (1.0 - a_0)) : std::max(a, a_0);
      const Vec3 photo = tissue.colour.row(v).transpose(), rest = colours({a_0, red, 0.0}).cwiseMax(1e-4);
      const double fade = kHueFades * gone(a);
      const double light = kLightKept * std::log(luminance(photo) / luminance(rest));
      const Vec3 model = colours({age, red, 0.0});
      for (int c = 0; c < 3; ++c) {
        const double beside = (1.0 - fade) * std::log(photo[c] / rest[c]) + fade * light;
        result(v, c) = a > 0.0 ? std::min(model[c] * std::exp(beside), 1.0) : photo[c];
      }
    }
  });
  return result;
}

Eigen::VectorXd faded_hue(const SenescencePattern& pattern, const Eigen::VectorXd& dryness) {
  Eigen::VectorXd faded(dryness.size());
  for (Eigen::Index v = 0; v < dryness.size(); ++v) faded[v] = gone(tissue_age(dryness[v], pattern.ahead[v]));
  return faded;
}

Image photo_texture(const BladeTexels& texels, const Image& photo, const PhotoTissue& tissue,
                    const PhotoLevels& levels, const Eigen::VectorXd& faded) {
  const PhotoPainter painter(texels, photo, tissue, levels, faded);
  Image texture = texels.blank();
  texels.for_each_row([&](const BladeRow& row) { painter.paint(row, texture); });
  bleed(texels.raster(), texture.rgb);
  return texture;
}

}  // namespace wilt
