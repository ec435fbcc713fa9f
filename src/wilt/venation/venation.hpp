// The veins of a leaf: tips on the margin, primary veins to them, secondary veins between.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/geodesics/fast_geodesics.hpp"
#include "wilt/geodesics/surface_path.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/leaf/species.hpp"
#include "wilt/venation/margin.hpp"

namespace wilt {

struct Tip {
  VertexId vertex;
  double s = 0.0, d = 0.0, prominence = 0.0;  ///< of the margin profile
};

struct Vein {
  int order = 1;     ///< 1: primary, 2: secondary
  int tip = -1;      ///< primary: the index of its tip
  int parent = -1;   ///< secondary: the index of the vein that it leaves
  SurfacePath path;  ///< from the petiole (or the parent) outwards
};

struct VenationOptions {
  PeakOptions peaks;
  GeodesicMethod geodesics = GeodesicMethod::fast;  ///< of distances; veins' paths are always exact
  int full_embedding_up_to = 1000;                  ///< vertices; above, landmarks
  int landmarks = 60;                               ///< >= 4
  bool secondary = true;                            ///< whether to draw secondary veins
  bool from_photo =
      true;  ///< whether veins that the leaf's photo shows clearly replace these (photo_veins.hpp)
  void validate() const;  ///< throws Error{configuration}
};

/// Where a leaf's veins are, and how far from them its vertices.
struct Venation {
  MarginProfile margin;
  std::vector<Tip> tips;    ///< in the order of s: r1, r2, ... of the paper
  std::vector<Vein> veins;  ///< primary veins first, in the order of their tips
  bool from_photo = false;  ///< whether they are those of the leaf's photo
  double embedding_stress = 0.0;
  Points2 flat;  ///< #V x 2, petiole at the origin, centroid on +y, faces counter-clockwise
  Eigen::VectorXd primary_distance;  ///< #V, gd_i: metres to the nearest primary vein
  Eigen::VectorXd vein_distance;     ///< #V, metres to the nearest primary or secondary vein
  Eigen::MatrixXd tip_distance;      ///< #tips x #V, metres, by options.geodesics
  struct Timings {
    double geodesics = 0.0, embedding = 0.0, venation = 0.0;
  } timings;  ///< seconds
};

/// From geometry, and the photo if the leaf has one: the leaf's name is not looked at; the secondary veins'
/// rule is given. Invariant to rigid motion, scale and relabelling (to round-off). Deterministic on any
/// number of threads. O(#V^2 log #V) with all pairs, O(#landmarks #V log #V) above. Throws Error{input} when
/// no tip is found or so many that their distances (tips x #V) are above 4e8, Error{configuration} for
/// options or a rule out of range.
Venation find_venation(const Leaf& leaf, const SecondaryVeinRule& rule, const VenationOptions& options = {},
                       const Monitor& monitor = {});

/// A vein as it was drawn.
struct DrawnVein {
  int order = 1;                     ///< 1 or 2
  std::vector<SurfacePoint> points;  ///< >= 1, from its base outwards; a primary vein may also come inwards
  int found = -1;                    ///< the index of the vein found that it is, unchanged; or -1
};

/// The veins that were found replaced by drawn ones, with distances and tips to match.
///
/// A primary vein begins at the petiole: what is missing up to there is added. Its tip is the margin vertex
/// nearest to its end. Secondary veins belong to the primary vein nearest to their base. Tips and primary
/// veins are put in the order of the margin. Drawing what was found gives `found` back, bit by bit.
/// Throws Error{input}, naming the vein by its place in `drawn`, when it leaves the blade, two primary veins
/// end at one tip, an order is neither 1 nor 2, or there is no primary vein. Deterministic.
Venation with_drawn_veins(const Leaf& leaf, const Venation& found, const std::vector<DrawnVein>& drawn,
                          const VenationOptions& options = {});

}  // namespace wilt
