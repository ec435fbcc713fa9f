// Symbols (Jacquemoud and Baret 1990): k absorption of one plate, theta its transmissivity, t_12 and r_12
// light that enters and is turned back at air -> leaf, t_21 and r_21 at leaf -> air, r_90 and t_90 one plate
// in diffuse light, R_sub and T_sub the N - 1 plates below the first.
#include "wilt/leaf/leaf_optics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

using Spectrum = std::array<double, kSpectralBands>;

// Refractive index of cell walls: 1.425 wet (mean of four species: Gausman, Allen and Escobar 1974), higher
// when dry; one value is taken for all.
constexpr double kIndex = 1.45;
constexpr double kFirstCone = 40.0 * std::numbers::pi / 180.0;  // of the light on the top plate: PROSPECT's

// CIE standard illuminant D65, relative power at 400, 410, ... 700 nm (CIE 15).
constexpr Spectrum kD65{82.75,  91.49,  93.43,  86.68,  104.87, 117.01, 117.81, 114.86,
                        115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05,
                        100.00, 96.33,  95.79,  88.69,  90.01,  89.60,  87.70,  83.29,
                        83.70,  80.03,  80.21,  82.28,  78.28,  69.72,  71.61};

double wavelength(int band) {
  return 400.0 + 10.0 * band;
}

// A bell of height 1 whose two sides differ in width.
double lobe(double nm, double centre, double below, double above) {
  const double x = (nm - centre) / (nm < centre ? below : above);
  return std::exp(-0.5 * x * x);
}

// CIE 1931 colour matching functions: the multi-lobe fit of Wyman, Sloan and Shirley (2013).
Vec3 observer(double nm) {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

// What each band gives to each channel of linear sRGB (IEC 61966-2-1); a channel's weights add up to 1.
std::array<Vec3, kSpectralBands> make_channel_weights() {
  Eigen::Matrix3d xyz_to_rgb;
  xyz_to_rgb << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  std::array<Vec3, kSpectralBands> weights;
  Vec3 white = Vec3::Zero();
  for (int b = 0; b < kSpectralBands; ++b) {
    weights[b] = kD65[b] * (xyz_to_rgb * observer(wavelength(b)));
    white += weights[b];
  }
  for (Vec3& weight : weights) weight = weight.cwiseQuotient(white);
  return weights;
}

// Absorption by one unit of each constituent.
struct Absorption {
  double chlorophyll, carotenoids, anthocyanin;  // cm2/ug
  double brown;                                  // per unit
  double dry_matter;                             // cm2/g
  double water;                                  // 1/cm
};

// Pure water (Pope and Fry 1997), logarithmic between its values.
double water_absorption(double nm) {
  constexpr std::array<double, 7> kAt{6.6e-5, 6.3e-5, 2.0e-4, 5.7e-4, 2.2e-3, 3.4e-3, 6.2e-3};
  constexpr std::array<double, 7> kNm{400, 440, 500, 550, 600, 650, 700};
  std::size_t i = 0;
  while (i + 2 < kNm.size() && nm > kNm[i + 1]) ++i;
  const double t = (nm - kNm[i]) / (kNm[i + 1] - kNm[i]);
  return kAt[i] * std::pow(kAt[i + 1] / kAt[i], t);
}

// Places of the bands. Chlorophyll in living tissue: 413, 435, 464 (b), 623, 652 (b), 676 nm (Hoepffner and
// Sathyendranath 1991), and a broad weak one at 580 nm for the light that winds its way through a leaf.
// Carotenoids: the three vibronic peaks of lutein, moved to the red as in living tissue. Anthocyanin: near
// 540 nm in leaves (Gitelson, Merzlyak and Chivkunova 2001) and a weak one in the blue. Brown pigments and
// dry matter fall steadily from blue to red.
// Heights, the widths of carotenoids and anthocyanin, and the two decay lengths: least squares on the
// reference colours of docs/method.md with a weak pull towards plausible heights (0.3 in the logarithm).
Absorption absorption_at(double nm) {
  const auto bell = [nm](double centre, double width) { return lobe(nm, centre, width, width); };
  Absorption k{};
  k.chlorophyll = 0.0245 * bell(413, 15) + 0.030 * bell(435, 13) + 0.0145 * bell(464, 18) +
                  0.0103 * bell(580, 70) + 0.0328 * bell(623, 18) + 0.025 * bell(652, 13) +
                  0.0498 * bell(676, 11);
  k.carotenoids = 0.099 * bell(435, 23.4) + 0.0669 * bell(463, 23.4) + 0.089 * bell(493, 23.4);
  k.anthocyanin = 0.0338 * bell(420, 45) + 0.0633 * bell(542, 37.3);
  k.brown = 0.603 * std::exp(-(nm - 400.0) / 246.0);
  k.dry_matter = 16.4 * std::exp(-(nm - 400.0) / 78.3);
  k.water = water_absorption(nm);
  return k;
}

struct Tables {
  std::array<Vec3, kSpectralBands> channel = make_channel_weights();
  std::array<Absorption, kSpectralBands> absorption = [] {
    std::array<Absorption, kSpectralBands> table{};
    for (int b = 0; b < kSpectralBands; ++b) table[b] = absorption_at(wavelength(b));
    return table;
  }();
  double first = entering_share(kFirstCone, kIndex);
  double t_12 = entering_share(0.5 * std::numbers::pi, kIndex);
};

double absorption_of(const LeafTissue& tissue, const Absorption& unit) {
  return tissue.chlorophyll * unit.chlorophyll + tissue.carotenoids * unit.carotenoids +
         tissue.anthocyanin * unit.anthocyanin + tissue.brown * unit.brown +
         tissue.dry_matter * unit.dry_matter + tissue.water * unit.water;
}

const Tables& tables() {
  static const Tables built;
  return built;
}

struct Plates {
  double reflectance, transmittance;
};

// `count` plates of reflectance r and transmittance t each, in diffuse light (Stokes 1862).
Plates stack(double r, double t, double count) {
  if (r + t >= 1.0 - 1e-12) {
    const double through = t / (t + (1.0 - t) * count);
    return {1.0 - through, through};
  }
  const double d = std::sqrt((1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * (1.0 - r - t));
  const double a = (1.0 + r * r - t * t + d) / (2.0 * r);
  const double b = std::pow((1.0 - r * r + t * t + d) / (2.0 * t), count);
  const double below = a * a * b * b - 1.0;
  return {a * (b * b - 1.0) / below, b * (a * a - 1.0) / below};
}

// N plates, each absorbing k; the light on the first comes from a cone, on the others from everywhere.
Plates plates(double k, double n_plates) {
  const Tables& table = tables();
  const double theta = k > 0.0 ? (1.0 - k) * std::exp(-k) + k * k * exponential_integral(k) : 1.0;
  const double t_21 = table.t_12 / (kIndex * kIndex), r_21 = 1.0 - t_21, r_12 = 1.0 - table.t_12;
  const double trips = 1.0 - r_21 * r_21 * theta * theta;
  const double t_first = table.first * theta * t_21 / trips;
  const double r_first = 1.0 - table.first + r_21 * theta * t_first;
  const double t_90 = table.t_12 * theta * t_21 / trips, r_90 = r_12 + r_21 * theta * t_90;
  const Plates sub = stack(r_90, t_90, n_plates - 1.0);
  const double between = 1.0 - sub.reflectance * r_90;
  return {r_first + t_first * sub.reflectance * t_90 / between, t_first * sub.transmittance / between};
}

}  // namespace

void LeafTissue::validate() const {
  const auto require = [](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw Error(ErrorCode::configuration,
                  fmt::format("leaf tissue: {} is {}; allowed: {} to {}", name, value, low, high));
  };
  require("structure", structure, 1.0, 4.0);
  require("chlorophyll", chlorophyll, 0.0, 120.0);
  require("carotenoids", carotenoids, 0.0, 30.0);
  require("anthocyanin", anthocyanin, 0.0, 60.0);
  require("brown", brown, 0.0, 5.0);
  require("water", water, 0.0, 0.1);
  require("dry_matter", dry_matter, 0.0, 0.05);
}

// Midpoint rule; smooth up to the square root at grazing angles, whose share is small.
double entering_share(double alpha, double n) {
  constexpr int kSteps = 2000;
  double passed = 0.0, sent = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = alpha * (i + 0.5) / kSteps;
    const double outside = std::cos(angle), sine = std::sin(angle) / n;
    const double inside = std::sqrt(1.0 - sine * sine);
    const double across = (outside - n * inside) / (outside + n * inside);
    const double along = (n * outside - inside) / (n * outside + inside);
    const double weight = std::sin(2.0 * angle);
    passed += weight * (1.0 - 0.5 * (across * across + along * along));
    sent += weight;
  }
  return passed / sent;
}

// Abramowitz and Stegun 5.1.11 and 5.1.22.
double exponential_integral(double x) {
  if (x <= 1.0) {
    double sum = -std::numbers::egamma - std::log(x), term = 1.0;
    for (int i = 1; i <= 18; ++i) {
      term *= -x / i;
      sum -= term / i;
    }
    return sum;
  }
  double fraction = x;
  for (int i = 60; i >= 1; --i) fraction = x + i / (1.0 + i / fraction);
  return std::exp(-x) / fraction;
}

LeafSpectrum leaf_spectrum(const LeafTissue& tissue) {
  tissue.validate();
  LeafSpectrum spectrum;
  for (int b = 0; b < kSpectralBands; ++b) {
    const Plates leaf =
        plates(absorption_of(tissue, tables().absorption[b]) / tissue.structure, tissue.structure);
    spectrum.reflectance[b] = leaf.reflectance;
    spectrum.transmittance[b] = leaf.transmittance;
  }
  return spectrum;
}

Vec3 spectrum_colour(const std::array<double, kSpectralBands>& spectrum) {
  Vec3 colour = Vec3::Zero();
  for (int b = 0; b < kSpectralBands; ++b) colour += spectrum[b] * tables().channel[b];
  return colour;
}

LeafLight leaf_light(const LeafTissue& tissue) {
  const LeafSpectrum spectrum = leaf_spectrum(tissue);
  LeafLight light{spectrum_colour(spectrum.reflectance).cwiseMax(0.0).cwiseMin(1.0),
                  spectrum_colour(spectrum.transmittance).cwiseMax(0.0)};
  // A saturated colour can leave the gamut above 1 as well as below 0.
  light.transmittance = light.transmittance.cwiseMin(Vec3::Ones() - light.reflectance);
  return light;
}

QuickReflectance::QuickReflectance() : table_(static_cast<std::size_t>(kStructures) * kAbsorptions) {
  for (int i = 0; i < kStructures; ++i) {
    for (int j = 0; j < kAbsorptions; ++j) {
      const double root = kMostRoot * j / (kAbsorptions - 1);
      table_[static_cast<std::size_t>(i * kAbsorptions + j)] =
          plates(root * root, 1.0 + kMostExtra * i / (kStructures - 1)).reflectance;
    }
  }
}

Vec3 QuickReflectance::operator()(const LeafTissue& tissue) const {
  tissue.validate();
  const double row = (tissue.structure - 1.0) * ((kStructures - 1) / kMostExtra);
  const int i = std::min(static_cast<int>(row), kStructures - 2);
  const double t = row - i;
  const double* few = &table_[static_cast<std::size_t>(i * kAbsorptions)];
  const double* more = few + kAbsorptions;
  const Tables& table = tables();
  Spectrum column;
  for (int b = 0; b < kSpectralBands; ++b)
    column[b] = std::min(std::sqrt(absorption_of(tissue, table.absorption[b]) / tissue.structure) *
                             ((kAbsorptions - 1) / kMostRoot),
                         kAbsorptions - 1.0);
  Vec3 colour = Vec3::Zero();
  for (int b = 0; b < kSpectralBands; ++b) {
    const int j = std::min(static_cast<int>(column[b]), kAbsorptions - 2);
    const double s = column[b] - j;
    colour +=
        ((1.0 - t) * ((1.0 - s) * few[j] + s * few[j + 1]) + t * ((1.0 - s) * more[j] + s * more[j + 1])) *
        table.channel[b];
  }
  return colour.cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace wilt
