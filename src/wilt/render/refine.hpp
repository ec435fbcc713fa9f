// A finer mesh through the vertices of a coarse one, for pictures.
#pragma once

#include "wilt/render/scene.hpp"

namespace wilt {

/// Splits every triangle in four, `levels` times (0 to 4). Vertices stay where they are, and come first.
///
/// A new vertex lies on the curved edge of the PN triangle of its two ends (A. Vlachos et al., "Curved PN
/// Triangles", 2001): (a + b) / 2 + ((b - a).(n_b) n_b - (b - a).(n_a) n_a) / 8. On the margin it lies on the
/// cubic through four successive vertices (N. Dyn et al., 1987), except beside a corner sharper than 40
/// degrees. Normals are required (of any length but 0); uv, colours, rest and water
/// follow linearly.
void refine(Surface& surface, int levels);

/// The closed loops of the margin as vertex numbers, in the order of the faces' own edges: edges with one
/// face. Vertices at one place count as one (skins are split along seams).
std::vector<std::vector<int>> margin_loops(const Points3& positions, const Faces& faces);

}  // namespace wilt
