// The points of a scan laid out in the plane. Inside the import room only.
#pragma once

#include <string>
#include <vector>

#include "wilt/core/monitor.hpp"
#include "wilt/core/types.hpp"
#include "wilt/import/scan_cleaning.hpp"

namespace wilt::detail {

struct ScanChart {
  std::vector<int> points;  ///< those of the piece that was taken, in ascending order
  Points2 uv;               ///< a row for each, in the scan's unit, nearly isometric
  Vec3 normal;              ///< the mean normal of the side from which u and v turn counter-clockwise
};

/// Lays the `nth` largest connected piece of a scan out in the plane, its upper side (the one that faces +z)
/// upwards: nodes some spacings apart are joined to their neighbours, the shortest paths between them
/// embedded (Isomap: Tenenbaum, de Silva, Langford 2000, with landmarks), then the stress of the short links
/// alone is majorised (de Leeuw 1977), which lets lobes and sinuses, around which paths bend, go where they
/// belong. Other points follow their nodes' local affine maps. Throws Error{input} when there is no `nth`
/// piece or the piece is no single sheet.
ScanChart lay_out(const CleanScan& scan, int nth, std::vector<std::string>& notes, const Monitor& monitor);

}  // namespace wilt::detail
