#include "wilt/simulation/config.hpp"
#include "wilt/simulation/deformation_model.hpp"

namespace wilt {
namespace {

using Words = std::vector<std::string>;

// A captureless lambda that names one member of Config.
#define WILT_FIELD(member) [](Config& c) -> Setting::Field { return &c.member; }

// key, unit, help, least, most, words, member
// clang-format off
std::vector<Setting> make_settings() {
  return {
    {"model", "", "deformation model",
     0, 0, model_names(), WILT_FIELD(model)},
    {"species", "", "preset that the defaults below come from",
     0, 0, {}, WILT_FIELD(species)},
    {"vertices", "", "vertices of the mesh, 200 or more; 0: 2000, or a mesh file's own",
     0, 1e6, {}, WILT_FIELD(vertices)},
    {"seed", "", "varies the individual leaf and the noise",
     0, 9e15, {}, WILT_FIELD(seed)},
    {"iterations", "", "time steps",
     0, 1e6, {}, WILT_FIELD(iterations)},
    {"frames", "", "frames written, the leaf at rest among them",
     2, 100000, {}, WILT_FIELD(frames)},
    {"dt", "time units", "time step",
     1e-4, 1, {}, WILT_FIELD(dt)},
    {"pin", "", "what is held: the petiole's one-ring, or nothing (results in the petiole's frame)",
     0, 0, Words{"ring", "free"}, WILT_FIELD(pin)},
    {"clip.seconds", "s", "playing time of the animation",
     0.01, 3600, {}, WILT_FIELD(clip.seconds)},
    {"clip.hours", "h", "drying time that 100 iterations stand for; stated in the files",
     0.01, 1e5, {}, WILT_FIELD(clip.hours)},
    {"veins.peaks", "", "rule for peaks of the margin profile",
     0, 0, Words{"prominence", "window"}, WILT_FIELD(veins.peaks)},
    {"veins.window_vertices", "margin vertices", "half window of the rule 'window'",
     1, 10000, {}, WILT_FIELD(veins.window_vertices)},
    {"veins.window_length", "perimeters", "window of the rule 'prominence'",
     0, 0.5, {}, WILT_FIELD(veins.window_length)},
    {"veins.min_prominence", "max(d)", "least prominence of a peak",
     0, 1, {}, WILT_FIELD(veins.min_prominence)},
    {"veins.geodesics", "", "distances of the embedding (veins themselves are always exact)",
     0, 0, Words{"fast", "exact"}, WILT_FIELD(veins.geodesics)},
    {"veins.full_embedding_up_to", "vertices", "above, landmarks are embedded",
     100, 50000, {}, WILT_FIELD(veins.full_embedding_up_to)},
    {"veins.landmarks", "", "landmarks of a large embedding",
     4, 5000, {}, WILT_FIELD(veins.landmarks)},
    {"veins.secondary", "", "draw secondary veins",
     0, 0, {}, WILT_FIELD(veins.secondary)},
    {"mass.min", "mass", "m_min: cell mass far from the veins",
     1e-3, 1e3, {}, WILT_FIELD(mass.min)},
    {"mass.max", "mass", "m_max: cell mass on the veins",
     1e-3, 1e3, {}, WILT_FIELD(mass.max)},
    {"mass.tau", "", "exponent of the mass distribution",
     1e-3, 1, {}, WILT_FIELD(mass.tau)},
    {"mass.water_fraction", "", "w / m at the start",
     0.05, 0.99, {}, WILT_FIELD(mass.water_fraction)},
    {"water.temperature_c", "C", "cell: air temperature",
     -20, 60, {}, WILT_FIELD(water.temperature_c)},
    {"water.humidity", "", "cell: relative humidity of the air",
     0, 1, {}, WILT_FIELD(water.humidity)},
    {"water.loss_rate", "mass / time unit", "w_loss of a cell (cell: at 20 C and 50 %)",
     0, 10, {}, WILT_FIELD(water.loss_rate)},
    {"water.diffusion", "", "lambda of the permeation",
     0, 100, {}, WILT_FIELD(water.diffusion)},
    {"water.dryness_scale", "", "share of the first water whose loss counts as dry",
     1e-3, 1, {}, WILT_FIELD(water.dryness_scale)},
    {"pressure.cell_constant", "", "c of the elastic modulus c / (1 - 2 mu)",
     0, 1, {}, WILT_FIELD(pressure.cell_constant)},
    {"pressure.poisson_ratio", "", "mu",
     0, 0.4999, {}, WILT_FIELD(pressure.poisson_ratio)},
    {"springs.stiffness", "force / length", "k_s",
     1e-3, 1e6, {}, WILT_FIELD(springs.stiffness)},
    {"springs.damping", "force time / length", "k_d",
     0, 1e3, {}, WILT_FIELD(springs.damping)},
    {"springs.vein_factor", "", "cell: stiffness of springs along veins over the others'",
     1, 1e3, {}, WILT_FIELD(springs.vein_factor)},
    {"swelling.coefficient", "", "k_p",
     0, 100, {}, WILT_FIELD(swelling.coefficient)},
    {"external.variant", "", "column of Table 2 for a leaf of seven tips",
     0, 0, Words{"a", "b", "c", "d", "e", "f"}, WILT_FIELD(external.variant)},
    {"external.range", "1 / length", "K_r",
     0, 100, {}, WILT_FIELD(external.range)},
    {"external.growth", "1 / time unit", "kappa: k_r over the first force",
     0, 100, {}, WILT_FIELD(external.growth)},
    {"external.scale", "", "multiplies all external forces; 0 switches them off",
     0, 100, {}, WILT_FIELD(external.scale)},
    {"bending.stiffness", "", "cell: k_b for a wrinkle length of 0.15 at S = 5",
     0, 10, {}, WILT_FIELD(bending.stiffness)},
    {"bending.wrinkle_length", "sqrt(blade area)", "cell: wrinkle length l_w",
     0.01, 2, {}, WILT_FIELD(bending.wrinkle_length)},
    {"bending.turgor_loss", "", "cell: share of the bending stiffness that goes with the turgor",
     0, 1, {}, WILT_FIELD(bending.turgor_loss)},
    {"bending.vein_factor", "", "cell: bending stiffness of veins over the lamina's",
     1, 1e4, {}, WILT_FIELD(bending.vein_factor)},
    {"shrinkage.amount", "", "cell: s of the differential strain",
     0, 10, {}, WILT_FIELD(shrinkage.amount)},
    {"shrinkage.vein_gap", "", "cell: weight of the lamina between veins",
     0, 10, {}, WILT_FIELD(shrinkage.vein_gap)},
    {"shrinkage.margin", "", "cell: weight of the margin",
     0, 10, {}, WILT_FIELD(shrinkage.margin)},
    {"shrinkage.noise", "", "cell: weight of the smooth noise",
     0, 10, {}, WILT_FIELD(shrinkage.noise)},
    {"strain_limit.threshold", "", "cell: strain at which springs begin to stiffen",
     0, 1, {}, WILT_FIELD(strain_limit.threshold)},
    {"strain_limit.stiffness", "", "cell: how fast they stiffen, in units of k_s",
     0, 1e5, {}, WILT_FIELD(strain_limit.stiffness)},
    {"strain_limit.area", "", "cell: share of its rest area below which a triangle resists",
     0.01, 0.99, {}, WILT_FIELD(strain_limit.area)},
    {"gravity.strength", "length / time unit^2", "cell: acceleration of gravity",
     0, 10, {}, WILT_FIELD(gravity.strength)},
    {"gravity.petiole_stiffness", "", "cell: bending stiffness of the fresh petiole, relative",
     0.01, 1e6, {}, WILT_FIELD(gravity.petiole_stiffness)},
    {"gravity.petiole_turgor_loss", "", "cell: share of it that goes with the turgor",
     0, 0.999, {}, WILT_FIELD(gravity.petiole_turgor_loss)},
    {"texture.size", "texels", "side of the blade's texture, 16 or more; 0: none, colours per vertex",
     0, 8192, {}, WILT_FIELD(texture.size)},
    {"reference.vertices", "", "cell: n_ref, the vertex count that masses and forces are stated for",
     10, 1e6, {}, WILT_FIELD(reference.vertices)},
    {"solver.tolerance", "", "relative residual of the midpoint equation",
     1e-12, 1e-2, {}, WILT_FIELD(solver.tolerance)},
    {"solver.max_newton", "", "Newton iterations before the step is halved",
     1, 1000, {}, WILT_FIELD(solver.max_newton)},
    {"solver.max_halvings", "", "halvings of a step before the run stops",
     0, 20, {}, WILT_FIELD(solver.max_halvings)},
  };
}
// clang-format on

#undef WILT_FIELD

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> table = make_settings();
  return table;
}

}  // namespace wilt
