// The leaf spread in the plane by its geodesic distances (internal to the room).
#pragma once

#include "wilt/venation/venation.hpp"

namespace wilt::detail {

struct Flattened {
  Points2 coordinates;  ///< #V x 2, the petiole at the origin, the centroid on +y, faces counter-clockwise
  double stress = 0.0;
  double embedding_seconds = 0.0;
};

/// SMACOF on all pairs of distances up to options.full_embedding_up_to vertices, from where landmarks put
/// them; landmarks alone above. `fast` is of this leaf.
Flattened flatten(const Leaf& leaf, const FastGeodesics& fast, const VenationOptions& options,
                  const Monitor& monitor);

}  // namespace wilt::detail
