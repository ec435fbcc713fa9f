// The colours of a leaf as it dries, over one texture.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "wilt/core/types.hpp"
#include "wilt/leaf/leaf.hpp"
#include "wilt/simulation/config.hpp"
#include "wilt/venation/venation.hpp"

namespace wilt {

/// Texture x colour is the leaf's colour (senescence.hpp; of a photographed leaf photo_tissue.hpp).
///
/// With C(s) the blade's colours in a state s of dryness, the texture holds C of the last of the `states`
/// times m >= 1 per channel, with its fine detail, and the colours are C(s) / (C(last) m); m is such that
/// none of the `states` asks for more than 1. Without a texture (`texture.size` 0, or texture coordinates
/// that cannot carry one) they are C(s). Deterministic on any number of threads.
class LeafPaint {
 public:
  /// `states`: dryness, #V each, 0 to 1; one or more. Refers to nothing afterwards. O(texels + #states #V).
  LeafPaint(const Leaf& leaf, const Venation& venation, const Config& config,
            const std::vector<Eigen::VectorXd>& states);
  LeafPaint(LeafPaint&&) noexcept;
  LeafPaint& operator=(LeafPaint&&) noexcept;
  ~LeafPaint();

  /// Linear RGB, #V x 3, at a dryness (#V).
  Points3 blade(const Eigen::VectorXd& dryness) const;
  /// Linear RGB of the whole stalk, which no texture multiplies.
  Vec3 stalk(const Eigen::VectorXd& dryness) const;

  /// Bytes of a JPEG that multiplies the blade's colours; empty: white.
  const std::string& texture() const;
  /// The same of the relief in the last state, a tangent-space normal map; empty: none.
  const std::string& normal_texture() const;

 private:
  struct Paint;
  std::unique_ptr<Paint> paint_;
};

}  // namespace wilt
