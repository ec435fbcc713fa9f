#include "wilt/simulation/uv_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "wilt/core/parallel.hpp"

namespace wilt {
namespace {

constexpr int kBand = 16;  // rows that one thread takes

// Rows or columns of texels.
struct Range {
  int first, last;  // inclusive
};

// Texels whose centre lies between two texture coordinates.
Range between(double low, double high, int size) {
  return {std::max(0, static_cast<int>(std::ceil(low * size - 0.5))),
          std::min(size - 1, static_cast<int>(std::floor(high * size - 0.5)))};
}

std::array<Vec2, 3> corners(const Skin& skin, int face) {
  return {skin.uv.row(skin.faces(face, 0)).transpose(), skin.uv.row(skin.faces(face, 1)).transpose(),
          skin.uv.row(skin.faces(face, 2)).transpose()};
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Faces by the bands that they touch, ascending.
std::vector<std::vector<int>> faces_by_band(const Skin& skin, int size) {
  std::vector<std::vector<int>> bands(static_cast<std::size_t>((size + kBand - 1) / kBand));
  for (int f = 0; f < skin.faces.rows(); ++f) {
    const auto c = corners(skin, f);
    const Range rows =
        between(std::min({c[0].y(), c[1].y(), c[2].y()}), std::max({c[0].y(), c[1].y(), c[2].y()}), size);
    for (int band = rows.first / kBand; band <= rows.last / kBand && rows.first <= rows.last; ++band)
      bands[static_cast<std::size_t>(band)].push_back(f);
  }
  return bands;
}

struct Count {
  std::int64_t covered = 0, twice = 0;
};

// A weight of a face's corner along a row: at the row's first texel, and from texel to texel.
struct Slope {
  double start, step;

  double at(int x) const { return start + x * step; }
  // Narrows `columns` to where the weight is not negative.
  void clip(Range& columns) const {
    constexpr double kSlack = 1e-9;
    if (std::abs(step) < 1e-15) {
      if (start < -kSlack) columns.last = -1;
      return;
    }
    const double edge = std::clamp((-kSlack - start) / step, -1e9, 1e9);
    if (step > 0.0) {
      columns.first = std::max(columns.first, static_cast<int>(std::ceil(edge)));
    } else {
      columns.last = std::min(columns.last, static_cast<int>(std::floor(edge)));
    }
  }
};

// The texels of one face within a band; the first face that covers a texel keeps it.
void fill(const Skin& skin, int face, const Range& band, UvRaster& raster, Count& count) {
  const auto c = corners(skin, face);
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  if (std::abs(area) < 1e-16) return;
  const Range wide = between(std::min({c[0].x(), c[1].x(), c[2].x()}),
                             std::max({c[0].x(), c[1].x(), c[2].x()}), raster.size);
  Range rows = between(std::min({c[0].y(), c[1].y(), c[2].y()}), std::max({c[0].y(), c[1].y(), c[2].y()}),
                       raster.size);
  rows = {std::max(rows.first, band.first), std::min(rows.last, band.last)};
  for (int y = rows.first; y <= rows.last; ++y) {
    const Vec2 p = Vec2(0.5, y + 0.5) / raster.size - c[0];
    const Slope u{cross(p, c[2] - c[0]) / area, (c[2].y() - c[0].y()) / (area * raster.size)},
        v{cross(c[1] - c[0], p) / area, -(c[1].y() - c[0].y()) / (area * raster.size)},
        w{1.0 - u.start - v.start, -u.step - v.step};
    Range columns = wide;
    for (const Slope& weight : {u, v, w}) weight.clip(columns);
    for (int x = columns.first; x <= columns.last; ++x) {
      int& owner = raster.face[static_cast<std::size_t>(y) * raster.size + x];
      if (owner < 0) {
        owner = face;
        ++count.covered;
      } else if (std::min({u.at(x), v.at(x), w.at(x)}) > 1e-6) {
        ++count.twice;
      }
    }
  }
}

// One level of the pyramid: means of the covered texels of 2 x 2, and where there are any.
struct Level {
  int size = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<char> known;

  template <class Known>
  static Level halved(int size, const std::vector<std::uint8_t>& rgb, const Known& is_known) {
    Level half;
    half.size = (size + 1) / 2;
    half.rgb.resize(3 * static_cast<std::size_t>(half.size) * half.size);
    half.known.resize(static_cast<std::size_t>(half.size) * half.size);
    parallel_for(half.size, kBand, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) half.average_row(y, size, rgb, is_known);
    });
    return half;
  }

 private:
  template <class Known>
  void average_row(int y, int fine_size, const std::vector<std::uint8_t>& fine, const Known& is_known) {
    for (int x = 0; x < size; ++x) {
      std::array<int, 3> sum{};
      int count = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, fine_size); ++v) {
        for (int u = 2 * x; u < std::min(2 * x + 2, fine_size); ++u) {
          const std::size_t i = static_cast<std::size_t>(v) * fine_size + u;
          if (!is_known(i)) continue;
          ++count;
          for (std::size_t c = 0; c < 3; ++c) sum[c] += fine[3 * i + c];
        }
      }
      const std::size_t i = static_cast<std::size_t>(y) * size + x;
      known[i] = count > 0;
      for (std::size_t c = 0; c < 3 && count > 0; ++c)
        rgb[3 * i + c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    }
  }
};

template <class Known>
void pull(int size, std::vector<std::uint8_t>& rgb, const Known& is_known, const Level& coarse) {
  parallel_for(size, kBand, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < size; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * size + x;
        if (is_known(i)) continue;
        const std::size_t from = static_cast<std::size_t>(y / 2) * coarse.size + x / 2;
        for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = coarse.rgb[3 * from + c];
      }
    }
  });
}

}  // namespace

std::optional<UvRaster> uv_raster(const Skin& skin, int size) {
  if (skin.uv.rows() == 0 || !skin.uv.allFinite() || skin.uv.minCoeff() < -1e-6 ||
      skin.uv.maxCoeff() > 1.0 + 1e-6)
    return std::nullopt;
  UvRaster raster{size, std::vector<int>(static_cast<std::size_t>(size) * size, -1)};
  const std::vector<std::vector<int>> bands = faces_by_band(skin, size);
  std::vector<Count> counts(bands.size());
  parallel_for(static_cast<int>(bands.size()), 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band) {
      const Range rows{band * kBand, std::min(size, (band + 1) * kBand) - 1};
      for (const int face : bands[static_cast<std::size_t>(band)])
        fill(skin, face, rows, raster, counts[static_cast<std::size_t>(band)]);
    }
  });
  Count sum;
  for (const Count& count : counts) sum.covered += count.covered, sum.twice += count.twice;
  if (sum.covered == 0 || sum.twice * 1000 > sum.covered) return std::nullopt;
  return raster;
}

Vec3 uv_weights(const Skin& skin, int face, const Vec2& uv) {
  const auto c = corners(skin, face);
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  const double u = cross(uv - c[0], c[2] - c[0]) / area, v = cross(c[1] - c[0], uv - c[0]) / area;
  return {1.0 - u - v, u, v};
}

void bleed(const UvRaster& raster, std::vector<std::uint8_t>& rgb) {
  const auto covered = [&raster](std::size_t i) { return raster.face[i] >= 0; };
  std::vector<Level> levels{Level::halved(raster.size, rgb, covered)};
  while (levels.back().size > 1) {
    const Level& last = levels.back();
    levels.push_back(Level::halved(last.size, last.rgb, [&last](std::size_t i) { return last.known[i]; }));
  }
  for (std::size_t k = levels.size() - 1; k > 0; --k) {
    Level& fine = levels[k - 1];
    pull(
        fine.size, fine.rgb, [&fine](std::size_t i) { return fine.known[i]; }, levels[k]);
  }
  pull(raster.size, rgb, covered, levels.front());
}

}  // namespace wilt
