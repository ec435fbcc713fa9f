// Pigments to light: energy, direction, and the reference colours.
#include "wilt/leaf/leaf_optics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "wilt/core/error.hpp"
#include "wilt/core/random.hpp"
#include "wilt/core/srgb.hpp"

namespace wilt {
namespace {

LeafTissue tissue(double n, double chlorophyll, double carotenoids, double anthocyanin, double brown,
                  double water, double dry_matter) {
  return {n, chlorophyll, carotenoids, anthocyanin, brown, water, dry_matter};
}

LeafTissue random_tissue(Random& random) {
  return tissue(random.uniform(1.0, 4.0), random.uniform(0.0, 120.0), random.uniform(0.0, 30.0),
                random.uniform(0.0, 60.0), random.uniform(0.0, 5.0), random.uniform(0.0, 0.1),
                random.uniform(0.0, 0.05));
}

// Oracle: 8-bit sRGB under D65 that PROSPECT-D gives for these constituents, within 3 of 255.
TEST(LeafOptics, ReachesTheReferenceColours) {
  struct Reference {
    LeafTissue leaf;
    Vec3 srgb;
  };
  const std::vector<Reference> references{{tissue(1.5, 40, 8, 0, 0, 0.015, 0.007), {72, 100, 51}},
                                          {tissue(1.6, 1, 8, 0, 0.05, 0.012, 0.006), {190, 147, 44}},
                                          {tissue(1.6, 3, 6, 25, 0.1, 0.01, 0.006), {122, 59, 57}},
                                          {tissue(2.2, 0.5, 2, 0, 1, 0.0012, 0.006), {151, 127, 92}}};
  for (const Reference& reference : references) {
    const Vec3 linear = leaf_light(reference.leaf).reflectance;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(255.0 * encode_srgb(linear[c]), reference.srgb[c], 3.0) << reference.srgb.transpose();
  }
}

// Property: energy, over the whole documented range, band by band and as colours.
TEST(LeafOptics, NeitherLosesNorMakesLight) {
  Random random(5, "tissue");
  for (int trial = 0; trial < 2000; ++trial) {
    const LeafTissue leaf = random_tissue(random);
    const LeafSpectrum spectrum = leaf_spectrum(leaf);
    for (int b = 0; b < kSpectralBands; ++b) {
      ASSERT_GE(spectrum.reflectance[b], 0.0);
      ASSERT_GE(spectrum.transmittance[b], 0.0);
      ASSERT_LE(spectrum.reflectance[b] + spectrum.transmittance[b], 1.0 + 1e-12);
    }
    const LeafLight light = leaf_light(leaf);
    ASSERT_GE(light.reflectance.minCoeff(), 0.0);
    ASSERT_GE(light.transmittance.minCoeff(), 0.0);
    ASSERT_LE((light.reflectance + light.transmittance).maxCoeff(), 1.0 + 1e-12);
  }
}

// Oracle: conservation. Plates that absorb nothing send everything on, whatever their number.
TEST(LeafOptics, WithoutAbsorptionAllLightComesOut) {
  for (const double n : {1.0, 1.0001, 1.5, 2.2, 4.0}) {
    const LeafSpectrum clear = leaf_spectrum(tissue(n, 0, 0, 0, 0, 0, 0));
    for (int b = 0; b < kSpectralBands; ++b)
      EXPECT_NEAR(clear.reflectance[b] + clear.transmittance[b], 1.0, 1e-9) << n;
    const LeafLight light = leaf_light(tissue(n, 0, 0, 0, 0, 0, 0));
    EXPECT_LT((light.reflectance + light.transmittance - Vec3::Ones()).cwiseAbs().maxCoeff(), 1e-9) << n;
  }
}

// Oracle: direction. More of a pigment: no band reflects or passes more, and at least one reflects less. A
// channel of sRGB takes a little light off where another one has its band (its weights there are negative),
// so the colour may gain there: by 0.03 at most, measured.
TEST(LeafOptics, IsMonotoneInEveryPigment) {
  double LeafTissue::*const pigments[] = {&LeafTissue::chlorophyll, &LeafTissue::carotenoids,
                                          &LeafTissue::anthocyanin, &LeafTissue::brown,
                                          &LeafTissue::dry_matter};
  const double steps[] = {6.0, 1.5, 3.0, 0.25, 0.0025};
  Random random(6, "tissue");
  for (int trial = 0; trial < 300; ++trial) {
    for (int i = 0; i < 5; ++i) {
      LeafTissue less = random_tissue(random);
      less.*pigments[i] *= 0.9;
      LeafTissue more = less;
      more.*pigments[i] += steps[i];
      const LeafSpectrum a = leaf_spectrum(less), b = leaf_spectrum(more);
      bool darker = false;
      for (int band = 0; band < kSpectralBands; ++band) {
        ASSERT_LE(b.reflectance[band], a.reflectance[band] + 1e-12) << i;
        ASSERT_LE(b.transmittance[band], a.transmittance[band] + 1e-12) << i;
        darker = darker || b.reflectance[band] + b.transmittance[band] <
                               a.reflectance[band] + a.transmittance[band] - 1e-6;
      }
      EXPECT_TRUE(darker) << i;
      EXPECT_LE((leaf_light(more).reflectance - leaf_light(less).reflectance).maxCoeff(), 0.03) << i;
    }
  }
}

// Oracle: the absorption of water (Pope and Fry 1997) times the path: a leaf of 0.1 cm of water absorbs less
// than 0.006 of red light even when light crosses it ten times. So water darkens, and hardly.
TEST(LeafOptics, WaterDarkensByNextToNothing) {
  const LeafTissue dry = tissue(1.8, 2, 3, 0, 0.2, 0.0, 0.006);
  LeafTissue wet = dry;
  wet.water = 0.05;
  const LeafLight a = leaf_light(dry), b = leaf_light(wet);
  EXPECT_LT(b.reflectance.sum(), a.reflectance.sum());
  EXPECT_LE((b.reflectance - a.reflectance).maxCoeff(), 1e-5);  // of red, see the test above
  EXPECT_LT((a.reflectance - b.reflectance).maxCoeff(), 1e-3);
}

// Oracle: direction. What a leaf loses with its water is seen as air in its tissue: more plates, paler.
TEST(LeafOptics, AirInTheTissueReflectsMoreAndPassesLess) {
  LeafTissue leaf = tissue(1.0, 20, 5, 2, 0.3, 0.01, 0.006);
  LeafSpectrum before = leaf_spectrum(leaf);
  for (leaf.structure = 1.3; leaf.structure <= 4.0; leaf.structure += 0.3) {
    const LeafSpectrum now = leaf_spectrum(leaf);
    for (int b = 0; b < kSpectralBands; ++b) {
      EXPECT_GE(now.reflectance[b], before.reflectance[b] - 1e-12);
      EXPECT_LE(now.transmittance[b], before.transmittance[b] + 1e-12);
    }
    before = now;
  }
}

// Oracle: analytic. Normal incidence gives 1 - ((n - 1) / (n + 1))^2; E_1 at Abramowitz and Stegun's values.
TEST(LeafOptics, PartsHaveTheirKnownValues) {
  const double n = 1.45, normal = 1.0 - std::pow((n - 1.0) / (n + 1.0), 2.0);
  EXPECT_NEAR(entering_share(1e-3, n), normal, 1e-6);
  EXPECT_LT(entering_share(0.5 * std::numbers::pi, n), entering_share(0.7, n));
  // Diffuse light on a medium of index 1.5: 0.092 are turned back (Walsh 1926; Judd 1942).
  EXPECT_NEAR(1.0 - entering_share(0.5 * std::numbers::pi, 1.5), 0.0918, 2e-4);
  EXPECT_NEAR(exponential_integral(0.5), 0.559773595, 1e-9);
  EXPECT_NEAR(exponential_integral(1.0), 0.219383934, 1e-9);
  EXPECT_NEAR(exponential_integral(2.0), 0.048900511, 1e-9);
  std::array<double, kSpectralBands> white{};
  white.fill(1.0);
  EXPECT_LT((spectrum_colour(white) - Vec3::Ones()).cwiseAbs().maxCoeff(), 1e-12);
}

// Differential: the table against the plates, from bare to black tissue.
TEST(QuickReflectance, IsThatOfThePlates) {
  const QuickReflectance quick;
  Random random(5, "tissues");
  for (int trial = 0; trial < 2000; ++trial) {
    LeafTissue leaf;
    leaf.structure = random.uniform(1.0, 4.0);
    const double much = std::pow(random.uniform(), 3.0);
    leaf.chlorophyll = 120.0 * much * random.uniform();
    leaf.carotenoids = 30.0 * much * random.uniform();
    leaf.anthocyanin = 60.0 * much * random.uniform();
    leaf.brown = 5.0 * much * random.uniform();
    leaf.dry_matter = 0.05 * much * random.uniform();
    EXPECT_LT((quick(leaf) - leaf_light(leaf).reflectance).cwiseAbs().maxCoeff(), 1e-3)
        << leaf.structure << " " << leaf.chlorophyll;
  }
}

TEST(LeafOptics, RefusesWhatIsOutOfRange) {
  LeafTissue leaf;
  leaf.chlorophyll = -1.0;
  try {
    leaf_light(leaf);
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration);
    EXPECT_NE(std::string(error.what()).find("chlorophyll is -1"), std::string::npos) << error.what();
  }
  leaf.chlorophyll = 0.0, leaf.structure = std::nan("");
  EXPECT_THROW(leaf.validate(), Error);
}

}  // namespace
}  // namespace wilt
